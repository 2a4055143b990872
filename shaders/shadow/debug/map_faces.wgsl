// Debug view: draws the depth in the faces of a shadow map. Near is bright, far is dark.

// True if the format of the target encodes sRGB itself.
override TARGET_ENCODES: bool = false;
override IS_PERSPECTIVE: bool = true;
// Near plane of a map, as a share of the scene's extent (src/render/shadow/map/projection.rs).
const NEAR: f32 = 1e-4;
const EMPTY: vec3f = vec3f(0.05, 0.08, 0.2);

struct Varying {
    @builtin(position) position: vec4f,
    // Position in the face, 0 to 1 from its top left corner.
    @location(0) uv: vec2f,
    @location(1) @interpolate(flat) face: u32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) face: u32) -> Varying {
    // One triangle that covers the face.
    let corner = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
    return Varying(vec4f(corner * 2.0 - 1.0, 0.0, 1.0), vec2f(corner.x, 1.0 - corner.y), face);
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4f {
    let size = vec2f(textureDimensions(map_depth));
    let depth = textureLoad(map_depth, vec2i(in.uv * size), i32(in.face), 0);
    // Distance from the light as a share of the scene's extent.
    let distance = select(1.0 - depth, NEAR / max(depth, NEAR * NEAR), IS_PERSPECTIVE);
    let grey = vec3f(1.0 - 0.95 * saturate(distance));
    let colour = select(grey, EMPTY, depth <= 0.0);
    return vec4f(select(colour, linear_from_srgb(colour), TARGET_ENCODES), 1.0);
}
