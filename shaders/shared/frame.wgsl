// Bind group 0 of every pass: camera, exposure and weights of one picture. Written by src/render/frame_uniform.rs.
//
// Three rules for lavapipe (Mesa 22.3), which cost hardware nothing:
// 1. No branch depends on a uniform buffer. lavapipe compiles a shader again for each value of a uniform that branches
//    depend on, and keeps every version. Values that select branches are in a storage buffer or are constants
//    of the pipeline.
// 2. No derivative is taken of a value that is loaded from storage. Derivatives also read pixels outside the triangle,
//    and for these lavapipe loads zero.
// 3. Where possible, vertices pass values of a uniform buffer on to their pixels. A fragment shader loads each number
//    for each pixel again, which takes as long as ten additions.

const MAX_GROUPS: u32 = 8u;

struct Frame {
    projection_from_world: mat4x4f,
    // Factor on the light of each group, rgb. The fourth channel is unused.
    group_weights: array<vec4f, MAX_GROUPS>,
    // Radiance of white paint that is added everywhere.
    ambient: vec3f,
    // Factor on direct irradiance.
    direct: f32,
    // Linear display colour of pixels without a surface.
    background: vec3f,
    // Factor on indirect irradiance.
    indirect: f32,
    // Power of two that brings the scene's radiance into the range of half floats. Every HDR texture is scaled by it.
    pre_exposure: f32,
    // Displayed = radiance x exposure; 0 selects the metered exposure.
    exposure: f32,
    num_vertices: u32,
    // Factor from the summed irradiance of the lights themselves to the radiance of white paint.
    live: f32,
    // Homogeneous position of the eye: a point with w = 1, or the direction towards an infinitely far eye with w = 0.
    eye: vec4f,
    // Scale of false colours: lower and upper end in lux, 1 if it is logarithmic, number of parts between lines.
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
