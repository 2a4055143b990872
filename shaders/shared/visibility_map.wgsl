// What the shadow map of the light sample sees is lit.

// The map has six faces round a point; else one.
override IS_CUBE: bool = false;

@group(2) @binding(0) var<uniform> shadow_map: ShadowMap;
@group(2) @binding(1) var map_depth: texture_depth_2d_array;
@group(2) @binding(2) var map_sampler: sampler;

fn visibility(point: vec3f, facet: vec3f) -> f32 {
    return seen_share(light, arrival(light, point), shadow_map, map_depth, map_sampler, IS_CUBE, point, facet);
}
