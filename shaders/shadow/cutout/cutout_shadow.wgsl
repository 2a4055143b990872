// Cut-out shadow pass: keeps the visible points whose line to the light hits an opaque part of a caster with holes,
// and discards the others.

struct CutoutCorner {
    // Position, metres.
    position: vec3f,
    // Smallest alpha that is solid.
    solid_alpha: f32,
    // Both coordinate sets.
    uv: vec4f,
    colour: vec4f,
}

// A box of the tree; its first child is the next node.
struct CutoutNode {
    low: vec3f,
    // The node to visit next if a line misses the box.
    skip: u32,
    high: vec3f,
    // The triangle of a leaf, or NO_TRIANGLE.
    triangle: u32,
}

const NO_TRIANGLE: u32 = 0xffffffffu;

// Three corners per triangle.
@group(3) @binding(0) var<storage, read> cutouts: array<CutoutCorner>;
@group(3) @binding(1) var<storage, read> nodes: array<CutoutNode>;

// Triangles are enlarged by this share of their size, so that no line passes between two of them.
const OVERLAP: f32 = 1e-5;
// Smallest absolute component of a direction. It prevents a division by zero.
const FLATTEST: f32 = 1e-30;
const ENDLESS: f32 = 1e30;

// Distance of a line's origin from its surface, as a share of the distance to the eye. It is the same for ray-traced
// shadows.
const TOWARDS_EYE: f32 = 1e-5;

@fragment
fn fragment(in: VisiblePoint) {
    let origin = in.point + TOWARDS_EYE * towards_eye(in.point);
    let to_light = light.position.xyz - light.position.w * origin;
    let inverse = 1.0 / select(to_light, vec3f(FLATTEST), abs(to_light) < vec3f(FLATTEST));
    let reach = select(ENDLESS, 1.0, light.position.w > 0.0);
    var at = 0u;
    while at < arrayLength(&nodes) {
        let node = nodes[at];
        if !is_crossed(node, origin, inverse, reach) {
            // Software drivers also run the shader for pixels outside the triangle, where loads return zero. The
            // maximum ends the loop of these pixels.
            at = max(node.skip, at + 1u);
            continue;
        }
        if node.triangle != NO_TRIANGLE && is_stopped(3u * node.triangle, origin, to_light) {
            return;
        }
        at += 1u;
    }
    discard;
}

// Returns true if the line hits the box of a node within its reach.
fn is_crossed(node: CutoutNode, origin: vec3f, inverse: vec3f, reach: f32) -> bool {
    let a = (node.low - origin) * inverse;
    let b = (node.high - origin) * inverse;
    let enter = min(a, b);
    let leave = max(a, b);
    return max(max(enter.x, enter.y), max(enter.z, 0.0)) <= min(min(leave.x, leave.y), min(leave.z, reach));
}

// Returns the vector from a point to the eye; a unit vector if the eye is infinitely far.
fn towards_eye(point: vec3f) -> vec3f {
    return frame.eye.xyz - frame.eye.w * point;
}

// Returns true if the line from `origin` to the light hits an opaque part of the triangle (Moeller and Trumbore 1997).
fn is_stopped(first: u32, origin: vec3f, to_light: vec3f) -> bool {
    let corner = cutouts[first].position;
    let edge_1 = cutouts[first + 1u].position - corner;
    let edge_2 = cutouts[first + 2u].position - corner;
    let p = cross(to_light, edge_2);
    let determinant = dot(edge_1, p);
    if determinant == 0.0 {
        return false;
    }
    let from_corner = origin - corner;
    let u = dot(from_corner, p) / determinant;
    let q = cross(from_corner, edge_1);
    let v = dot(to_light, q) / determinant;
    let distance = dot(edge_2, q) / determinant;
    let is_beyond_light = (light.position.w > 0.0) & (distance >= 1.0);
    if u < -OVERLAP || v < -OVERLAP || u + v > 1.0 + OVERLAP || distance < 0.0 || is_beyond_light {
        return false;
    }
    return alpha_at(first, vec3f(1.0 - u - v, u, v)) >= cutouts[first].solid_alpha;
}

fn alpha_at(first: u32, weights: vec3f) -> f32 {
    let uv = weights.x * cutouts[first].uv + weights.y * cutouts[first + 1u].uv + weights.z * cutouts[first + 2u].uv;
    let colour = weights.x * cutouts[first].colour + weights.y * cutouts[first + 1u].colour
        + weights.z * cutouts[first + 2u].colour;
    let alpha = material.base_colour.a * colour.a;
    return alpha * textureSampleLevel(base_texture, base_sampler, coordinate(material.base_slot, uv), 0.0).a;
}
