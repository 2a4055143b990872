// Item buffer of a hemicube face: stores for each pixel the visible element (Weghorst, Hooper, Greenberg 1984).
//
// The input triangles are drawn, not the elements. Each fragment finds its element by descending the triangle's
// bisection tree with its barycentric position. So the cost depends on the number of input triangles and pixels alone.
//
// An item is 0 for nothing, else the element id + 1. The highest bit marks the black back of a single-sided surface.

struct Vertex {
    @builtin(vertex_index) index: u32,
    @location(0) position: vec3<f32>,
    // Root of the triangle's tree, and the item offset of its back (0 if the back is black).
    @location(1) ids: vec2<u32>,
}

struct Triangle {
    // Index into `cutouts` + 1; 0 if the triangle is opaque.
    cutout: u32,
    // Vertex alpha of the three corners, 8 bits each.
    vertex_alpha: u32,
    uv_0: vec2<f32>,
    uv_1: vec2<f32>,
    uv_2: vec2<f32>,
}

// The alpha channel of a material that lets light through.
struct Cutout {
    first_texel: u32,
    size: vec2<u32>,
    // Wrap mode of u in the low half, of v in the high half: 0 repeat, 1 mirror, 2 clamp.
    wrap: u32,
    alpha_factor: f32,
    // Smallest alpha that counts as solid. If it is negative, the surface lets the share 1 - alpha of the light pass.
    cutoff: f32,
}

// View of one face of one hemicube, at a dynamic offset. It is a uniform, because software drivers read storage anew
// for every vertex.
@group(0) @binding(0) var<uniform> view: mat4x4<f32>;
@group(0) @binding(1) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(2) var<storage, read> tree: array<u32>;
@group(0) @binding(3) var<storage, read> cutouts: array<Cutout>;
@group(0) @binding(4) var<storage, read> alphas: array<u32>;

// True if the scene has surfaces that let light through.
override HAS_CUTOUTS: bool = false;

const FIRST_ELEMENT: u32 = 1u;
const BLACK_BACK: u32 = 0x80000000u;

struct Varyings {
    @builtin(position) position: vec4<f32>,
    // Barycentric weights of the first two corners. There are few locations, because software drivers set up each one
    // for every triangle.
    @location(0) weights: vec2<f32>,
    // Triangle, root of its tree, and item offset of its back.
    @location(1) @interpolate(flat) ids: vec3<u32>,
}

@vertex
fn vertex(in: Vertex) -> Varyings {
    let corner = in.index % 3u;
    var out: Varyings;
    out.position = view * vec4<f32>(in.position, 1.0);
    out.weights = vec2<f32>(f32(corner == 0u), f32(corner == 1u));
    out.ids = vec3<u32>(in.index / 3u, in.ids);
    return out;
}

@fragment
fn fragment(in: Varyings, @builtin(front_facing) is_front: bool) -> @location(0) u32 {
    let barycentric = vec3<f32>(in.weights, 1.0 - in.weights.x - in.weights.y);
    if HAS_CUTOUTS && is_hole(in.ids.x, barycentric, in.position.xy) {
        discard;
    }
    let back_offset = in.ids.z;
    let side = select(select(back_offset, BLACK_BACK, back_offset == 0u), 0u, is_front);
    return side + FIRST_ELEMENT + element_at(in.ids.y, barycentric);
}

// Returns the element that contains a barycentric position. `Node` in src/patch describes the words of the tree.
//
// Software drivers also shade pixels outside the triangle, and their reads return zero. A zero node ends the descent.
fn element_at(root: u32, barycentric: vec3<f32>) -> u32 {
    var w = barycentric;
    var node = root;
    while (node & 3u) != 0u {
        let turn = node & 3u;
        w = select(select(w, w.yzx, turn == 2u), w.zxy, turn == 3u);
        node = tree[(node >> 2u) + u32(w.z > w.y)];
        w = halved(w);
    }
    var path = 0u;
    for (var depth = (node >> 2u) & 15u; depth > 0u; depth--) {
        path = 2u * path + u32(w.z > w.y);
        w = halved(w);
    }
    return (node >> 6u) + path;
}

// Returns the barycentric weights in that half of the triangle that contains the point.
fn halved(w: vec3<f32>) -> vec3<f32> {
    let at_midpoint = 2.0 * min(w.y, w.z);
    let rest = abs(w.y - w.z);
    return vec3<f32>(at_midpoint, select(w.x, rest, w.z > w.y), select(rest, w.x, w.z > w.y));
}

fn is_hole(index: u32, w: vec3<f32>, pixel: vec2<f32>) -> bool {
    let triangle = triangles[index];
    if triangle.cutout == 0u {
        return false;
    }
    let cutout = cutouts[triangle.cutout - 1u];
    let uv = triangle.uv_0 * w.x + triangle.uv_1 * w.y + triangle.uv_2 * w.z;
    let vertex_alpha = dot(unpack4x8unorm(triangle.vertex_alpha).xyz, w);
    let alpha = texel(cutout, uv) * cutout.alpha_factor * vertex_alpha;
    if cutout.cutoff < 0.0 {
        // Screen-door transparency: a pixel is solid with probability alpha.
        return alpha <= unit_hash(vec2<u32>(pixel) ^ vec2<u32>(index * 1973u, index));
    }
    return alpha < cutout.cutoff;
}

fn texel(cutout: Cutout, uv: vec2<f32>) -> f32 {
    let at = vec2<i32>(floor(uv * vec2<f32>(cutout.size)));
    let x = wrapped(at.x, i32(cutout.size.x), cutout.wrap & 0xffffu);
    let y = wrapped(at.y, i32(cutout.size.y), cutout.wrap >> 16u);
    let texel = cutout.first_texel + u32(y) * cutout.size.x + u32(x);
    return f32((alphas[texel / 4u] >> (8u * (texel % 4u))) & 0xffu) / 255.0;
}

fn wrapped(at: i32, size: i32, mode: u32) -> i32 {
    if mode == 2u {
        return clamp(at, 0, size - 1);
    }
    let period = select(size, 2 * size, mode == 1u);
    let place = ((at % period) + period) % period;
    return min(place, 2 * size - 1 - place);
}

fn unit_hash(p: vec2<u32>) -> f32 {
    let state = (p.x * 1664525u + p.y * 1013904223u) * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return f32(((word >> 22u) ^ word) >> 8u) / 16777216.0;
}
