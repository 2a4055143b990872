// Surface pass: what vertices hand to pixels whose light lies in tiles.

const IS_TILED: bool = true;

struct Varying {
    @builtin(position) @invariant position: vec4f,
    // Of vertex and material.
    @location(1) colour: vec4f,
    @location(2) base_and_metallic_uv: vec4f,
    @location(3) emissive_uv_and_scales: vec4f,
    // Where the light lies in a tile. Not at the centroid: of that lavapipe scales even what is constant.
    @location(4) light: vec4f,
    // Of the material where it has no textures.
    @location(5) @interpolate(flat) emission_and_metallic: vec4f,
}

@vertex
fn vertex(in: Vertex) -> Varying {
    return surface_varying(in);
}
