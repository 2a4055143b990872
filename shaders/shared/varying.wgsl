// Surface pass: what vertices hand to pixels.

struct Varying {
    @builtin(position) @invariant position: vec4f,
    @location(0) @interpolate(perspective, centroid) normal: vec3f,
    // Of vertex and material.
    @location(1) colour: vec4f,
    @location(2) base_and_metallic_uv: vec4f,
    @location(3) emissive_uv_and_scales: vec4f,
    // Radiance of an ideal white surface; centroid, so that it is never extrapolated beyond the triangle.
    @location(4) @interpolate(perspective, centroid) white_radiance: vec3f,
    // Of the material where it has no textures.
    @location(5) @interpolate(flat) emission_and_metallic: vec4f,
    // Where light lies in tiles.
    @location(6) place: vec4f,
}

fn handed_place(in: Varying) -> vec4f {
    return in.place;
}

@vertex
fn vertex(in: Vertex) -> Varying {
    var out = surface_varying(in);
    out.place = tile_place(in);
    return out;
}
