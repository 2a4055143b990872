// Overlay: draws lines and tinted faces over a finished picture. Surfaces in front of them hide them.

// True if the format of the target encodes sRGB itself.
override TARGET_ENCODES: bool = false;
// Shift of marks towards the eye, as a share of the distance; in an orthographic view in metres.
const LIFT: f32 = 1e-3;

struct Varying {
    @builtin(position) position: vec4f,
    // Display colour, sRGB, straight alpha.
    @location(0) colour: vec4f,
}

// Draws the depth of the scene.
@vertex
fn solid(@location(0) position: vec3f) -> @builtin(position) vec4f {
    return frame.projection_from_world * vec4f(position, 1.0);
}

// Writes no colour, because the picture already shows the scene.
@fragment
fn unseen() -> @location(0) vec4f {
    return vec4f(0.0);
}

@vertex
fn mark(@location(0) position: vec3f, @location(1) colour: vec4f) -> Varying {
    let lifted = position + LIFT * (frame.eye.xyz - frame.eye.w * position);
    return Varying(frame.projection_from_world * vec4f(lifted, 1.0), colour);
}

@fragment
fn tint(in: Varying) -> @location(0) vec4f {
    return vec4f(select(in.colour.rgb, linear_from_srgb(in.colour.rgb), TARGET_ENCODES), in.colour.a);
}
