// Shadow volume pass: counts in the stencil how many volumes each visible point is in.
//
// A corner is where it is, or infinitely far behind itself as the light sees it: (V w - L, 0). The reversed infinite
// projection puts w = 0 at depth 0 exactly, so nothing is ever clipped far away and both caps exist.

const INFINITELY_FAR: f32 = 1.0;
const SHORTEST: f32 = 1e-30;

struct Corner {
    // Metres; w says where the corner is to be.
    @location(0) position: vec4f,
}

@vertex
fn vertex(in: Corner) -> @builtin(position) @invariant vec4f {
    if in.position.w == INFINITELY_FAR {
        let away = in.position.xyz * light.place.w - light.place.xyz;
        // Of length one: clipping between corners of very different sizes is not exact.
        return frame.projection_from_world * vec4f(away / max(length(away), SHORTEST), 0.0);
    }
    return frame.projection_from_world * vec4f(in.position.xyz, 1.0);
}

// Depth of a far plane that the projection itself does not have; 0 means none.
override FAR_DEPTH: f32 = 0.0;

// Takes away what such a far plane would: to show what that does to volumes.
@fragment
fn beyond(@builtin(position) position: vec4f) {
    if position.z < FAR_DEPTH {
        discard;
    }
}
