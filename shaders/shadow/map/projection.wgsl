// Projection of a shadow map for the passes that read it. Written by src/render/shadow/map/projection.rs.

struct ShadowMap {
    // Texel of a point = origin + scale x (right, down); a perspective map divides the second term by `ahead`. Right,
    // down and ahead are coordinates in light space, metres. The centres of texels are whole numbers.
    origin: vec2f,
    scale: f32,
    // Depth = depth_scale / ahead, or depth_offset + depth_scale x ahead for a directional light.
    depth_scale: f32,
    depth_offset: f32,
    // 1 / number of texels across a face.
    inverse_resolution: f32,
    // Shift of a point along its normal, texels.
    normal_offset: f32,
    // Shift of a point towards the light, as a multiple of its surface's change of depth from texel to texel.
    slope_bias: f32,
    // Smallest change of depth from texel to texel that is assumed of a surface: an absolute part, and a part relative
    // to its depth.
    rounding: vec2f,
    // Number of texels in each direction that a lookup reads beside the texel that holds the point.
    reach: u32,
    padding: u32,
}

// Texels across a block (shaders/shadow/map/block_planes.wgsl).
const BLOCK: u32 = 8u;

// Returns the smallest change of depth from texel to texel that is assumed of a surface at a depth.
fn least_fall(rounding: vec2f, depth: f32) -> f32 {
    return rounding.x + rounding.y * depth;
}
