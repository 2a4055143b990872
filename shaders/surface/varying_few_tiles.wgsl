// Surface pass: what vertices hand to pixels that add the direct light of a few light samples to light in tiles.

const IS_TILED: bool = true;

struct Varying {
    @builtin(position) @invariant position: vec4f,
    @location(0) @interpolate(perspective, centroid) normal: vec3f,
    // Of vertex and material.
    @location(1) colour: vec4f,
    @location(2) base_and_metallic_uv: vec4f,
    @location(3) emissive_uv_and_scales: vec4f,
    // Where the light lies in a tile. Not at the centroid: of that lavapipe scales even what is constant.
    @location(4) light: vec4f,
    // Of the material where it has no textures.
    @location(5) @interpolate(flat) emission_and_metallic: vec4f,
    // Metres, world space.
    @location(6) @interpolate(perspective, centroid) point: vec3f,
    // As in shared/lit_point.wgsl, in the space of each light.
    @location(7) middle_0: vec3f,
    @location(8) normal_0: vec3f,
    @location(9) middle_1: vec3f,
    @location(10) normal_1: vec3f,
    @location(11) middle_2: vec3f,
    @location(12) normal_2: vec3f,
    @location(13) middle_3: vec3f,
    @location(14) normal_3: vec3f,
}
