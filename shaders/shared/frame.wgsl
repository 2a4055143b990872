// Bind group 0 of every pass: what one picture asks for. Written by src/render/frame_uniform.rs.
//
// No branch may depend on a uniform buffer: for the values of such uniforms lavapipe compiles the shader anew each time that
// they are bound, and keeps what it has compiled. So choices lie in a storage buffer. Nothing of which derivatives are
// taken may come from there: outside of triangles, where derivatives look, lavapipe loads zero.
//
// What pixels need of a uniform buffer they are handed by the vertices where that can be: of Mesa before 23, fragment
// shaders load each number of it for each pixel anew, which takes as long as ten sums.

const MAX_GROUPS: u32 = 8u;

struct Frame {
    projection_from_world: mat4x4f,
    // Factor on the light of each group, rgb.
    group_weights: array<vec4f, MAX_GROUPS>,
    // Radiance of an ideal white surface that is added everywhere.
    ambient: vec3f,
    // Factor on direct irradiance.
    direct: f32,
    // Display colour, linear, where nothing is hit.
    background: vec3f,
    // Factor on indirect irradiance.
    indirect: f32,
    // Power of two that keeps the scene's radiance within half floats; every HDR texture is scaled by it.
    pre_exposure: f32,
    // Displayed = radiance x exposure; 0 asks for the metered one.
    exposure: f32,
    num_vertices: u32,
    // From irradiance of the lights themselves to the radiance of white paint.
    live: f32,
    // Homogeneous: the eye with w = 1, or the direction towards it with w = 0.
    eye: vec4f,
    // Ends of the scale of false colours in lux, whether it is logarithmic, and parts that lines cut it into.
    lux_scale: vec4f,
}

struct Choices {
    tone_map: u32,
    num_groups: u32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> choices: Choices;

fn group_weight(group: u32) -> vec3f {
    return frame.group_weights[min(group, MAX_GROUPS - 1u)].rgb;
}
