// Lookup of a shadow map with percentage-closer filtering (Reeves, Salesin and Cook 1987).
//
// The lit share of a point is the mean of the comparisons of its depth with the texels round it, not the comparison
// with a mean depth. Over a filter of several texels a slanted surface would shadow itself; so each texel is compared
// with the depth of the receiver's plane in the middle of that texel (receiver plane depth bias, Isidoro 2006,
// "Shadow mapping: GPU-based tips and techniques"):
//
//     lit = mean over texels (i, j) of  [ depth + dx slope.x + dy slope.y + bias >= stored(i, j) ]
//
// (dx, dy) is the offset of the texel from the point; slope (`fall` in the code) is the change of depth from texel to
// texel along the surface. Depth is reversed: larger is nearer to the light.

// Another bit of `kind`: the map has six faces, in the order +X -X +Y -Y +Z -Z. Otherwise it has one, towards -Z.
const HAS_CUBE: u32 = 32u;
const FACE_AHEAD: u32 = 5u;

// Radius of the filter, texels: it is (2 r + 1) texels wide.
override PCF_RADIUS: i32 = 1;
// True if points are shifted along their normal (normal offset).
override HAS_NORMAL_OFFSET: bool = true;

// Returns the fraction of a light sample that reaches a point, according to its map. If `receives` is false, there is
// no lookup and the result is 0.
fn visible_share(
    receives: bool,
    kind: u32,
    arrival: Arrival,
    shadow_map: ShadowMap,
    map: texture_depth_2d_array,
    block_planes: texture_2d_array<f32>,
    gathered: sampler,
    at: Receiver
) -> f32 {
    var from_light = at.from_light;
    if HAS_NORMAL_OFFSET {
        from_light += normal_offset(kind, arrival, shadow_map, at);
    }
    // A shading normal can face the light while the triangle itself does not.
    let faces_light = dot(at.facet, arrival.to_light) > 0.0;
    let matters = receives && faces_light;
    let point = in_map(kind, shadow_map, from_light, at.facet);
    return select(0.0, pcf(matters, shadow_map, map, block_planes, gathered, point), matters);
}

// Returns the shift along the normal: larger for light at a grazing angle.
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
    // Position in the face, texels.
    texel: vec2f,
    depth: f32,
    // Slope of the surface: change of depth from texel to texel. The plane of a triangle is a plane in the map, too.
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
    let texel = shadow_map.origin + vec2f(scale, -scale) * seen.xy;
    let depth = shadow_map.depth_scale * select(inverse_ahead, seen.z, is_parallel) + shadow_map.depth_offset;
    // A surface seen edge-on from the light has an infinite slope; the slope then counts as zero.
    let divisor = shadow_map.scale * select(dot(normal, seen), -normal.z, is_parallel);
    let slope = select(shadow_map.depth_scale / divisor, 0.0, divisor == 0.0);
    return MapPoint(layer, texel, depth, vec2f(slope, -slope) * normal.xy);
}

// The PCF loop: returns the mean of the comparisons over the texels round a point. The filter covers the first and the
// last texel of each row and column only partly, and their weight is the covered fraction. So shadows move smoothly.
// One `textureGather` reads 2 x 2 texels.
fn pcf(
    matters: bool,
    shadow_map: ShadowMap,
    map: texture_depth_2d_array,
    block_planes: texture_2d_array<f32>,
    gathered: sampler,
    at: MapPoint
) -> f32 {
    let fall = abs(at.fall.x) + abs(at.fall.y) + least_fall(shadow_map.rounding, at.depth);
    let depth = at.depth + shadow_map.slope_bias * fall;
    // If all texels of the block show one plane, one comparison decides.
    let block = textureLoad(block_planes, vec2u(at.texel + 0.5) / BLOCK, at.layer, 0);
    let is_plane = block.w > 0.0;
    let before_plane = select(0.0, 1.0, depth >= block.x + block.y * at.texel.x + block.z * at.texel.y);
    let share = at.texel - floor(at.texel);
    var sum = 0.0;
    // Software drivers run the first iteration of a loop for inactive pixels too; these all read the same texel.
    let is_enough = is_plane || !matters;
    let num_gathers = select((PCF_RADIUS + 1) * (PCF_RADIUS + 1), 0, is_enough);
    let middle = select(floor(at.texel), vec2f(0.0), is_enough);
    for (var i = 0; i < num_gathers; i++) {
        // 2 x 2 texels, in the order of textureGather: from the lower left, counter-clockwise.
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

// Returns a vector along the axes of a face's camera (right, up, ahead): its coordinates in another order and with
// other signs.
fn on_face(face: u32, v: vec3f) -> vec3f {
    let s = select(1.0, -1.0, (face & 1u) == 1u);
    let along_x = vec3f(s * v.z, v.y, s * v.x);
    let along_y = vec3f(s * v.x, v.z, s * v.y);
    let along_z = vec3f(-s * v.x, v.y, s * v.z);
    return select(select(along_z, along_y, face < 4u), along_x, face < 2u);
}
