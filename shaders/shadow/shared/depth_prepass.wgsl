// Depth prepass: draws the depth of the visible surfaces, before light is added to them.

struct Vertex {
    @location(0) position: vec3f,
    @location(2) uv: vec4f,
    @location(3) colour: vec4f,
}

struct Varying {
    @builtin(position) @invariant position: vec4f,
    @location(0) colour: vec4f,
    @location(1) uv: vec2f,
}

@vertex
fn vertex(in: Vertex) -> Varying {
    return Varying(frame.projection_from_world * vec4f(in.position, 1.0), material.base_colour * in.colour,
        coordinate(material.base_slot, in.uv));
}

// Discards the holes of masked surfaces; the others have no fragment shader.
@fragment
fn fragment(in: Varying) {
    _ = coverage(base_colour(in.colour, in.uv).a);
}
