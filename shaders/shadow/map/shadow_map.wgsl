// Shadow map pass: draws the depth of the casters, seen from the light (Williams 1978).

struct MapFace {
    projection_from_world: mat4x4f,
}

@group(1) @binding(0) var<uniform> map_face: MapFace;

struct Vertex {
    @location(0) position: vec3f,
    @location(2) uv: vec4f,
    @location(3) colour: vec4f,
}

struct Varying {
    @builtin(position) position: vec4f,
    @location(0) colour: vec4f,
    @location(1) uv: vec2f,
}

@vertex
fn vertex(in: Vertex) -> Varying {
    return Varying(map_face.projection_from_world * vec4f(in.position, 1.0), material.base_colour * in.colour,
        coordinate(material.base_slot, in.uv));
}

// Smallest alpha of a blending surface that throws a shadow.
const HALF_OPAQUE: f32 = 0.5;

// Discards the holes of casters; opaque casters have no fragment shader.
@fragment
fn fragment(in: Varying) {
    let alpha = base_colour(in.colour, in.uv).a;
    if alpha < select(material.alpha_cutoff, HALF_OPAQUE, ALPHA_MODE == ALPHA_BLEND) {
        discard;
    }
}
