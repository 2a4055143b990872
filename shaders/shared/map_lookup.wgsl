// What a shadow map sees is lit. Written by src/render/shadow/map_projection.rs.

struct ShadowMap {
    // Place of a point in the map, texels = origin + scale x (right, down) of light space, per metre ahead where light is
    // not parallel; the middles of texels are whole numbers.
    origin: vec2f,
    scale: f32,
    // Depth = depth_scale / ahead, or depth_offset + depth_scale x ahead where light is parallel.
    depth_scale: f32,
    depth_offset: f32,
    // 1 over the texels across a face.
    inverse_resolution: f32,
    // Shift of a point along its normal, texels.
    normal_offset: f32,
    // Shift towards the light: as deep as the surface falls over so many texels.
    slope_bias: f32,
    // The least that a surface is taken to fall over a texel: of all depths, and as a share of the depth.
    rounding: vec2f,
    padding: vec2f,
}

// Another bit of the kind of a light: its map has six faces round it, in the order +X -X +Y -Y +Z -Z; else one, towards -Z.
const HAS_CUBE: u32 = 32u;
const FACE_AHEAD: u32 = 5u;

// Texels each way over which shadows are softened.
override PCF_RADIUS: i32 = 1;
// Points are shifted along their normal.
override HAS_NORMAL_OFFSET: bool = true;

// Share of a light sample that its map lets through to a point.
fn seen_share(
    kind: u32,
    arrival: Arrival,
    shadow_map: ShadowMap,
    depth: texture_depth_2d_array,
    gathered: sampler,
    at: Receiver
) -> f32 {
    var from_light = at.from_light;
    if HAS_NORMAL_OFFSET {
        from_light += normal_offset(kind, arrival, shadow_map, at);
    }
    // A smooth normal may see light that the triangle itself turns its back on.
    let faces_light = dot(at.facet, arrival.to_light) > 0.0;
    let place = in_map(kind, shadow_map, from_light, at.facet);
    return select(0.0, lit_share(shadow_map, depth, gathered, place), faces_light);
}

// Away from the surface, the more the flatter the light falls on it.
fn normal_offset(kind: u32, arrival: Arrival, shadow_map: ShadowMap, at: Receiver) -> vec3f {
    let unit = normalize(at.facet);
    let cosine = dot(unit, arrival.to_light);
    let along_axes = abs(at.from_light);
    let axis_distance = max(along_axes.x, max(along_axes.y, along_axes.z));
    let texel = select(axis_distance, 1.0, has(kind, IS_PARALLEL)) / shadow_map.scale;
    return texel * shadow_map.normal_offset * sqrt(saturate(1.0 - cosine * cosine)) * unit;
}

// A point of a surface in the map.
struct MapPoint {
    layer: u32,
    // Texels.
    place: vec2f,
    depth: f32,
    // Change of depth from texel to texel along the surface, which is a plane in the map, too.
    fall: vec2f,
}

fn in_map(kind: u32, shadow_map: ShadowMap, from_light: vec3f, facet: vec3f) -> MapPoint {
    let face = select(FACE_AHEAD, cube_face(from_light), has(kind, HAS_CUBE));
    let layer = select(0u, face, has(kind, HAS_CUBE));
    let seen = on_face(face, from_light);
    let normal = on_face(face, facet);
    let is_parallel = has(kind, IS_PARALLEL);
    let inverse_ahead = 1.0 / seen.z;
    let scale = shadow_map.scale * select(inverse_ahead, 1.0, is_parallel);
    let place = shadow_map.origin + vec2f(scale, -scale) * seen.xy;
    let depth = shadow_map.depth_scale * select(inverse_ahead, seen.z, is_parallel) + shadow_map.depth_offset;
    // A surface seen edge on from the light has no slope to speak of.
    let divisor = shadow_map.scale * select(dot(normal, seen), -normal.z, is_parallel);
    let slope = select(shadow_map.depth_scale / divisor, 0.0, divisor == 0.0);
    return MapPoint(layer, place, depth, vec2f(slope, -slope) * normal.xy);
}

// Mean over the texels round a point, each compared with the depth of the surface in its middle. Of the texels in a row,
// the first and the last count by the share that the window covers of them.
fn lit_share(shadow_map: ShadowMap, map: texture_depth_2d_array, gathered: sampler, at: MapPoint) -> f32 {
    let least = shadow_map.rounding.x + shadow_map.rounding.y * at.depth;
    let depth = at.depth + shadow_map.slope_bias * (abs(at.fall.x) + abs(at.fall.y) + least);
    let share = at.place - floor(at.place);
    var sum = 0.0;
    for (var y = 0; y <= PCF_RADIUS; y++) {
        for (var x = 0; x <= PCF_RADIUS; x++) {
            // Two by two, first those below.
            let first = vec2f(vec2i(2 * x, 2 * y) - PCF_RADIUS);
            let corner = (floor(at.place) + first + 1.0) * shadow_map.inverse_resolution;
            let stored = textureGather(map, gathered, corner, at.layer);
            let offset = first - share;
            let right = offset.x + vec4f(0.0, 1.0, 1.0, 0.0);
            let down = offset.y + vec4f(1.0, 1.0, 0.0, 0.0);
            let surface = depth + at.fall.x * right + at.fall.y * down;
            let before = select(vec2f(1.0), 1.0 - share, vec2i(x, y) == vec2i(0));
            let after = select(vec2f(1.0), share, vec2i(x, y) == vec2i(PCF_RADIUS));
            let weights = vec4f(before.x, after.x, after.x, before.x) * vec4f(after.yy, before.yy);
            sum += dot(select(vec4f(0.0), weights, surface >= stored), vec4f(1.0));
        }
    }
    let width = f32(2 * PCF_RADIUS + 1);
    return sum / (width * width);
}

fn cube_face(direction: vec3f) -> u32 {
    let size = abs(direction);
    if size.x >= max(size.y, size.z) {
        return select(0u, 1u, direction.x < 0.0);
    }
    if size.y >= size.z {
        return select(2u, 3u, direction.y < 0.0);
    }
    return select(4u, FACE_AHEAD, direction.z < 0.0);
}

// Right, up and ahead as the camera of a face looks: to look through one is to change the order and signs of coordinates.
fn on_face(face: u32, v: vec3f) -> vec3f {
    let s = select(1.0, -1.0, (face & 1u) == 1u);
    let along_x = vec3f(s * v.z, v.y, s * v.x);
    let along_y = vec3f(s * v.x, v.z, s * v.y);
    let along_z = vec3f(-s * v.x, v.y, s * v.z);
    return select(select(along_z, along_y, face < 4u), along_x, face < 2u);
}
