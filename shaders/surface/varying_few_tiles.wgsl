// Surface pass: the values that vertices pass to pixels. The pixels add the direct light of a few light samples to
// light in tiles.

const IS_TILED: bool = true;

struct Varying {
    @builtin(position) @invariant position: vec4f,
    @location(0) @interpolate(perspective, centroid) normal: vec3f,
    // Base colour of vertex x base colour of material.
    @location(1) colour: vec4f,
    @location(2) base_and_metallic_uv: vec4f,
    @location(3) emissive_uv_and_scales: vec4f,
    // Place of the light in a tile. It is not interpolated at the centroid, where lavapipe (Mesa 22.3) scales even
    // constants.
    @location(4) light: vec4f,
    // Emission and metallic factor of the material, before textures.
    @location(5) @interpolate(flat) emission_and_metallic: vec4f,
    // Position in world space, metres.
    @location(6) @interpolate(perspective, centroid) point: vec3f,
    // For each light: position at the pixel centre, and shading normal, both in the space of the light.
    @location(7) middle_0: vec3f,
    @location(8) normal_0: vec3f,
    @location(9) middle_1: vec3f,
    @location(10) normal_1: vec3f,
    @location(11) middle_2: vec3f,
    @location(12) normal_2: vec3f,
    @location(13) middle_3: vec3f,
    @location(14) normal_3: vec3f,
}
