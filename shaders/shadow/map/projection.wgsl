// Projection of a shadow map for the passes that read it. Written by src/render/shadow/map/projection.rs.

struct ShadowMap {
    // Texel of a point = origin + scale x (right, down), and for a perspective map x 1 / ahead. Coordinates are those
    // of light space, metres; the centres of texels are whole numbers.
    origin: vec2f,
    scale: f32,
    // Depth = depth_scale / ahead, or depth_offset + depth_scale x ahead for a directional light.
    depth_scale: f32,
    depth_offset: f32,
    // 1 over the texels across a face.
    inverse_resolution: f32,
    // Shift of a point along its normal, texels.
    normal_offset: f32,
    // Shift of a point towards the light, in changes of its surface's depth from texel to texel.
    slope_bias: f32,
    // Least change of depth from texel to texel that is assumed of a surface: absolute, and as a share of its depth.
    rounding: vec2f,
    // Texels in each direction that a lookup reads beside the one that holds the point.
    reach: u32,
    padding: u32,
}

// Texels across a block (shaders/shadow/map/block_planes.wgsl).
const BLOCK: u32 = 8u;

// Returns the least change of depth from texel to texel that is assumed of a surface at a depth.
fn least_fall(rounding: vec2f, depth: f32) -> f32 {
    return rounding.x + rounding.y * depth;
}
