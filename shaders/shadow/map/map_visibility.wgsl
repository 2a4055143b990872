// Visibility by the shadow map of the light sample.

// True if the map has six faces round a point light, false if it has one.
override IS_CUBE: bool = false;

@group(2) @binding(0) var<uniform> shadow_map: ShadowMap;
@group(2) @binding(1) var map_depth: texture_depth_2d_array;
@group(2) @binding(2) var map_sampler: sampler;
@group(2) @binding(3) var block_planes: texture_2d_array<f32>;

fn visibility(arrival: Arrival, at: Receiver) -> f32 {
    let kind = light.kind | select(0u, HAS_CUBE, IS_CUBE);
    return visible_share(true, kind, arrival, shadow_map, map_depth, block_planes, map_sampler, at);
}
