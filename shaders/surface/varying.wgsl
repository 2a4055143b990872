// Surface pass: the values that vertices pass to pixels.

const IS_TILED: bool = false;

struct Varying {
    @builtin(position) @invariant position: vec4f,
    // Base colour of vertex x base colour of material.
    @location(1) colour: vec4f,
    @location(2) base_and_metallic_uv: vec4f,
    @location(3) emissive_uv_and_scales: vec4f,
    // Radiance of white paint. It is interpolated at the centroid, so that it is never extrapolated beyond the
    // triangle.
    @location(4) @interpolate(perspective, centroid) light: vec4f,
    // Emission and metallic factor of the material, before textures.
    @location(5) @interpolate(flat) emission_and_metallic: vec4f,
}

@vertex
fn vertex(in: Vertex) -> Varying {
    return surface_varying(in);
}
