// A shadow map as passes read it. Written by src/render/shadow/map_projection.rs.

struct ShadowMap {
    // Place of a point in the map, texels = origin + scale x (right, down) of light space, per metre ahead where light is
    // not parallel; the middles of texels are whole numbers.
    origin: vec2f,
    scale: f32,
    // Depth = depth_scale / ahead, or depth_offset + depth_scale x ahead where light is parallel.
    depth_scale: f32,
    depth_offset: f32,
    // 1 over the texels across a face.
    inverse_resolution: f32,
    // Shift of a point along its normal, texels.
    normal_offset: f32,
    // Shift towards the light: as deep as the surface falls over so many texels.
    slope_bias: f32,
    // The least that a surface is taken to fall over a texel: of all depths, and as a share of the depth.
    rounding: vec2f,
    // Texels each way that are looked at beside the one in which a point lies.
    reach: u32,
    padding: u32,
}

// Texels across a block of the map's overview (shaders/map_overview.wgsl).
const BLOCK: u32 = 8u;

// The least that a surface of some depth is taken to fall over a texel.
fn least_fall(rounding: vec2f, depth: f32) -> f32 {
    return rounding.x + rounding.y * depth;
}
