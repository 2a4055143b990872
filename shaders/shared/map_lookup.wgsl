// What a shadow map sees is lit.

// Another bit of the kind of a light: its map has six faces round it, in the order +X -X +Y -Y +Z -Z; else one, towards -Z.
const HAS_CUBE: u32 = 32u;
const FACE_AHEAD: u32 = 5u;

// Texels each way over which shadows are softened.
override PCF_RADIUS: i32 = 1;
// Points are shifted along their normal.
override HAS_NORMAL_OFFSET: bool = true;

// Share of a light sample that its map lets through to a point, which receives light or not.
fn seen_share(
    receives: bool,
    kind: u32,
    arrival: Arrival,
    shadow_map: ShadowMap,
    map: texture_depth_2d_array,
    overview: texture_2d_array<f32>,
    gathered: sampler,
    at: Receiver
) -> f32 {
    var from_light = at.from_light;
    if HAS_NORMAL_OFFSET {
        from_light += normal_offset(kind, arrival, shadow_map, at);
    }
    // A smooth normal may see light that the triangle itself turns its back on.
    let faces_light = dot(at.facet, arrival.to_light) > 0.0;
    let matters = receives && faces_light;
    let place = in_map(kind, shadow_map, from_light, at.facet);
    return select(0.0, lit_share(matters, shadow_map, map, overview, gathered, place), matters);
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
fn lit_share(
    matters: bool,
    shadow_map: ShadowMap,
    map: texture_depth_2d_array,
    overview: texture_2d_array<f32>,
    gathered: sampler,
    at: MapPoint
) -> f32 {
    let fall = abs(at.fall.x) + abs(at.fall.y) + least_fall(shadow_map.rounding, at.depth);
    let depth = at.depth + shadow_map.slope_bias * fall;
    // Where all texels show one plane, the point is on or before it, or behind.
    let block = textureLoad(overview, vec2u(at.place + 0.5) / BLOCK, at.layer, 0);
    let is_plane = block.w > 0.0;
    let before_plane = select(0.0, 1.0, depth >= block.x + block.y * at.place.x + block.z * at.place.y);
    let share = at.place - floor(at.place);
    var sum = 0.0;
    // Software drivers go through a loop once, whether it is meant or not: then not far into memory.
    let is_enough = is_plane || !matters;
    let num_gathers = select((PCF_RADIUS + 1) * (PCF_RADIUS + 1), 0, is_enough);
    let middle = select(floor(at.place), vec2f(0.0), is_enough);
    for (var i = 0; i < num_gathers; i++) {
        // Two by two, first those below.
        let number = vec2i(i % (PCF_RADIUS + 1), i / (PCF_RADIUS + 1));
        let first = vec2f(2 * number - PCF_RADIUS);
        let corner = (middle + first + 1.0) * shadow_map.inverse_resolution;
        let stored = textureGather(map, gathered, corner, at.layer);
        let offset = first - share;
        let right = offset.x + vec4f(0.0, 1.0, 1.0, 0.0);
        let down = offset.y + vec4f(1.0, 1.0, 0.0, 0.0);
        let surface = depth + at.fall.x * right + at.fall.y * down;
        let before = select(vec2f(1.0), 1.0 - share, number == vec2i(0));
        let after = select(vec2f(1.0), share, number == vec2i(PCF_RADIUS));
        let weights = vec4f(before.x, after.x, after.x, before.x) * vec4f(after.yy, before.yy);
        sum += dot(select(vec4f(0.0), weights, surface >= stored), vec4f(1.0));
    }
    let width = f32(2 * PCF_RADIUS + 1);
    return select(sum / (width * width), before_plane, is_plane);
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
