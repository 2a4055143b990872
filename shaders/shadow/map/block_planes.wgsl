// Block planes pass: fits a plane to each block of texels of a shadow map, if all of its texels lie on one.
//
// A plane in space is a plane in a map, too. Most blocks lie within a large triangle; there one comparison with the
// plane replaces a filter over many texels (see src/render/shadow/map/block_planes.rs).

// Largest deviation from the plane that is allowed, as a share of the plane's change of depth per texel. The deviation
// stays below the bias.
const TOLERANCE: f32 = 0.1;

@group(0) @binding(0) var<uniform> shadow_map: ShadowMap;
@group(0) @binding(1) var map_depth: texture_depth_2d_array;
@group(0) @binding(2) var map_sampler: sampler;

struct Varying {
    // One pixel for each block of texels.
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) layer: u32,
    @location(1) @interpolate(flat) reach: u32,
    @location(2) @interpolate(flat) inverse_resolution: f32,
    @location(3) @interpolate(flat) rounding: vec2f,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) layer: u32) -> Varying {
    // One triangle that covers the target.
    let corner = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
    let position = vec4f(corner * 2.0 - 1.0, 0.0, 1.0);
    return Varying(position, layer, shadow_map.reach, shadow_map.inverse_resolution, shadow_map.rounding);
}

// Returns the plane's depth extrapolated to texel (0, 0) of the map, its change per texel to the right and downwards,
// and 1 if all texels of the block lie on it, else 0.
@fragment
fn fragment(in: Varying) -> @location(0) vec4f {
    let span = BLOCK + 2u * in.reach;
    let first = floor(in.position.xy) * f32(BLOCK) - f32(in.reach);
    let last = f32(span - 1u);
    let corner = depth_at(in, first);
    let fall = (vec2f(depth_at(in, first + vec2f(last, 0.0)), depth_at(in, first + vec2f(0.0, last))) - corner) / last;
    var worst = vec4f(0.0);
    for (var y = 0u; y < span; y += 2u) {
        for (var x = 0u; x < span; x += 2u) {
            let at = vec2f(f32(x), f32(y));
            let stored = textureGather(map_depth, map_sampler, (first + at + 1.0) * in.inverse_resolution, in.layer);
            let right = at.x + vec4f(0.0, 1.0, 1.0, 0.0);
            let down = at.y + vec4f(1.0, 1.0, 0.0, 0.0);
            worst = max(worst, abs(corner + fall.x * right + fall.y * down - stored));
        }
    }
    let allowed = TOLERANCE * (abs(fall.x) + abs(fall.y) + least_fall(in.rounding, corner));
    return vec4f(corner - dot(fall, first), fall, select(0.0, 1.0, all(worst <= vec4f(allowed))));
}

fn depth_at(in: Varying, texel: vec2f) -> f32 {
    return textureSampleLevel(map_depth, map_sampler, (texel + 0.5) * in.inverse_resolution, in.layer, 0);
}
