// Surface pass: the values that vertices pass to pixels whose light is in tiles.

const IS_TILED: bool = true;

struct Varying {
    @builtin(position) @invariant position: vec4f,
    // Base colour of vertex x base colour of material.
    @location(1) colour: vec4f,
    @location(2) base_and_metallic_uv: vec4f,
    @location(3) emissive_uv_and_scales: vec4f,
    // Place of the light in a tile. It is not interpolated at the centroid, where lavapipe (Mesa 22.3) scales even
    // constants.
    @location(4) light: vec4f,
    // Emission and metallic factor of the material, before textures.
    @location(5) @interpolate(flat) emission_and_metallic: vec4f,
}

@vertex
fn vertex(in: Vertex) -> Varying {
    return surface_varying(in);
}
