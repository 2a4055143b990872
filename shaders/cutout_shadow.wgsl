// Cut-out shadow pass: keeps the points between which and the light a caster with holes is solid.

struct CutoutCorner {
    // Metres.
    position: vec3f,
    // Smallest alpha that is solid.
    solid_alpha: f32,
    // Both coordinate sets.
    uv: vec4f,
    colour: vec4f,
}

// Three corners a triangle.
@group(3) @binding(0) var<storage, read> cutouts: array<CutoutCorner>;

// A line begins this share of the way towards the eye, as rays of the ray-traced shadow do.
const TOWARDS_EYE: f32 = 1e-5;

@fragment
fn fragment(in: VisiblePoint) {
    let origin = in.point + TOWARDS_EYE * towards_eye(in.point);
    let to_light = light.place.xyz - light.place.w * origin;
    for (var first = 0u; first < arrayLength(&cutouts); first += 3u) {
        if is_stopped(first, origin, to_light) {
            return;
        }
    }
    discard;
}

// From a point to the eye; one metre towards it where it is infinitely far.
fn towards_eye(point: vec3f) -> vec3f {
    return frame.eye.xyz - frame.eye.w * point;
}

// The line from `origin` to the light meets a solid place of the triangle (Moeller, Trumbore 1997).
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
    let is_beyond_light = light.place.w > 0.0 && distance >= 1.0;
    if u < 0.0 || v < 0.0 || u + v > 1.0 || distance < 0.0 || is_beyond_light {
        return false;
    }
    return alpha_at(first, vec3f(1.0 - u - v, u, v)) >= cutouts[first].solid_alpha;
}

fn alpha_at(first: u32, weights: vec3f) -> f32 {
    let uv = weights.x * cutouts[first].uv + weights.y * cutouts[first + 1u].uv + weights.z * cutouts[first + 2u].uv;
    let colour = weights.x * cutouts[first].colour + weights.y * cutouts[first + 1u].colour
        + weights.z * cutouts[first + 2u].colour;
    let alpha = material.base_colour.a * colour.a;
    if material.base_slot.is_used == 0u {
        return alpha;
    }
    return alpha * textureSampleLevel(base_texture, base_sampler, coordinate(material.base_slot, uv), 0.0).a;
}
