// Fills tiles with light: the radiance of white paint at each texel, linear in each element
// (src/baked/coarse/tiles.rs).

const NOTHING: u32 = 0xffffffffu;
const PI: f32 = 3.14159265358979;
// Largest value that a half float holds, with room for rounding.
const LARGEST_HALF: f32 = 65000.0;
// True if direct light comes from the lights themselves. Tiles then hold no direct light.
override LIT_BY_LIGHTS: bool = false;

struct Element {
    vertices: array<u32, 3>,
    // Texels of the corners: column + 65,536 x row.
    corners: array<u32, 3>,
}

// Irradiance of the vertices: [vertex], direct then indirect, three floats each.
@group(1) @binding(0) var<storage, read> weighted: array<f32>;
@group(1) @binding(1) var<storage, read> elements: array<Element>;
// Element of each texel: [texel], row by row.
@group(1) @binding(2) var<storage, read> element_of: array<u32>;
// Texels beyond the long sides, packed like corners.
@group(1) @binding(3) var<storage, read> beyond: array<u32>;
@group(1) @binding(4) var light: texture_storage_2d<rgba16float, write>;
// Radiance of white paint at the vertices, scaled by pre-exposure: [vertex], four halves.
@group(1) @binding(5) var<storage, read_write> radiances: array<vec2u>;

@compute @workgroup_size(64)
fn sum_up(@builtin(global_invocation_id) invocation: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let vertex = invocation.x + 64u * groups.x * invocation.y;
    if vertex >= frame.num_vertices {
        return;
    }
    let at = 6u * vertex;
    let direct = vec3f(weighted[at], weighted[at + 1u], weighted[at + 2u]);
    let indirect = vec3f(weighted[at + 3u], weighted[at + 4u], weighted[at + 5u]);
    let irradiance = select(frame.direct, 0.0, LIT_BY_LIGHTS) * direct + frame.indirect * indirect;
    let radiance = storable(frame.pre_exposure * (frame.ambient + irradiance / PI));
    radiances[vertex] = vec2u(pack2x16float(radiance.rg), pack2x16float(vec2f(radiance.b, 0.0)));
}

@compute @workgroup_size(64)
fn fill(@builtin(global_invocation_id) invocation: vec3u) {
    let texel = invocation.xy;
    let side = textureDimensions(light).x;
    if texel.x < side && element_of[texel.y * side + texel.x] != NOTHING {
        store(texel, radiance_of(texel));
    }
}

// Extrapolates the texels beyond a long side from the three texels before them. So bilinear reads on the side are
// exact.
@compute @workgroup_size(64)
fn fill_beyond(@builtin(global_invocation_id) invocation: vec3u) {
    if invocation.x >= arrayLength(&beyond) {
        return;
    }
    let texel = unpacked(beyond[invocation.x]);
    let across = radiance_of(texel - vec2u(1u, 0u));
    let down = radiance_of(texel - vec2u(0u, 1u));
    store(texel, across + down - radiance_of(texel - vec2u(1u, 1u)));
}

fn store(texel: vec2u, radiance: vec3f) {
    textureStore(light, texel, vec4f(storable(radiance), 1.0));
}

fn storable(radiance: vec3f) -> vec3f {
    return clamp(radiance, vec3f(-LARGEST_HALF), vec3f(LARGEST_HALF));
}

// Returns the radiance at a texel that has an element.
fn radiance_of(texel: vec2u) -> vec3f {
    let element = elements[element_of[texel.y * textureDimensions(light).x + texel.x]];
    let a = vec2f(unpacked(element.corners[0]));
    let ab = vec2f(unpacked(element.corners[1])) - a;
    let ac = vec2f(unpacked(element.corners[2])) - a;
    let ap = vec2f(texel) - a;
    let area = cross_2d(ab, ac);
    let b_weight = cross_2d(ap, ac) / area;
    let c_weight = cross_2d(ab, ap) / area;
    return (1.0 - b_weight - c_weight) * radiance_at(element.vertices[0])
        + b_weight * radiance_at(element.vertices[1])
        + c_weight * radiance_at(element.vertices[2]);
}

fn radiance_at(vertex: u32) -> vec3f {
    let halves = radiances[vertex];
    return vec3f(unpack2x16float(halves.x), unpack2x16float(halves.y).x);
}

fn unpacked(texel: u32) -> vec2u {
    return vec2u(texel & 0xffffu, texel >> 16u);
}

fn cross_2d(a: vec2f, b: vec2f) -> f32 {
    return a.x * b.y - a.y * b.x;
}
