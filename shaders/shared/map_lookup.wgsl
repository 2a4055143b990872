// What a shadow map sees is lit. Written by src/render/shadow/map_projection.rs.

struct ShadowMap {
    // Of a spot or a directional light.
    projection_from_world: mat4x4f,
    // The same for planes.
    plane_from_world: mat4x4f,
    // Of the faces of a point's cube: half width and near plane at one metre from the light.
    half_width: f32,
    near: f32,
    // Width of a texel, metres; for perspective maps at one metre from the light.
    texel: f32,
    // Shift of a point along its normal, texels.
    normal_offset: f32,
    // Shift towards the light: as deep as the surface falls over so many texels.
    slope_bias: f32,
    padding: vec3f,
}

// Texels each way over which shadows are softened.
override PCF_RADIUS: i32 = 1;

// Share of a light sample that its map lets through to a point; the map has six faces round the light, in the order
// +X -X +Y -Y +Z -Z, or one for a spot or a directional light.
fn seen_share(
    light: LightSample,
    shadow_map: ShadowMap,
    depth: texture_depth_2d_array,
    compared: sampler_comparison,
    is_cube: bool,
    point: vec3f,
    facet: vec3f
) -> f32 {
    let offset = light.place.xyz - light.place.w * point;
    let to_light = normalize(offset);
    let cosine = dot(facet, to_light);
    // A smooth normal may see light that the triangle itself turns its back on.
    if cosine <= 0.0 {
        return 0.0;
    }
    let axis_distance = max(abs(offset.x), max(abs(offset.y), abs(offset.z)));
    let texel = shadow_map.texel * select(1.0, axis_distance, light.place.w > 0.0);
    // Away from the surface, the more the flatter the light falls on it.
    let slope = sqrt(saturate(1.0 - cosine * cosine));
    let shifted = point + texel * shadow_map.normal_offset * slope * facet;
    if is_cube {
        return lit_share(depth, compared, in_cube(shadow_map, shifted - light.place.xyz, facet), shadow_map.slope_bias);
    }
    return lit_share(depth, compared, in_map(shadow_map, shifted, facet), shadow_map.slope_bias);
}

// A point of a surface in the map.
struct MapPoint {
    face: u32,
    // -1..1 across and up, and depth.
    place: vec3f,
    // Change of depth across and up the map along the surface, which is a plane in the map, too.
    slope: vec2f,
}

fn in_map(shadow_map: ShadowMap, point: vec3f, facet: vec3f) -> MapPoint {
    let clip = shadow_map.projection_from_world * vec4f(point, 1.0);
    let plane = shadow_map.plane_from_world * vec4f(facet, -dot(facet, point));
    return MapPoint(0u, clip.xyz / clip.w, flat(-plane.xy / plane.z, plane.z));
}

// The faces of the cube lie along the axes: to look through one is to change the order and signs of coordinates.
fn in_cube(shadow_map: ShadowMap, from_light: vec3f, facet: vec3f) -> MapPoint {
    let face = cube_face(from_light);
    let seen = on_face(face, from_light);
    let normal = on_face(face, facet);
    let distance = dot(normal, seen);
    let place = vec3f(seen.xy / (seen.z * shadow_map.half_width), shadow_map.near / seen.z);
    return MapPoint(face, place, flat(normal.xy * (shadow_map.near * shadow_map.half_width / distance), distance));
}

// A surface seen edge on from the light has no slope to speak of.
fn flat(slope: vec2f, divisor: f32) -> vec2f {
    return select(slope, vec2f(0.0), divisor == 0.0);
}

// Mean over the texels round a point, each compared with the depth of the surface there; each comparison is interpolated
// between four, whose spread the bias covers.
//
// Of the texels in a row, the first and the last count by the share that the window covers of them. Two neighbours are
// one interpolated comparison, at the place where interpolation weighs them so.
fn lit_share(map: texture_depth_2d_array, compared: sampler_comparison, at: MapPoint, slope_bias: f32) -> f32 {
    let size = vec2f(textureDimensions(map));
    let bias = slope_bias * dot(abs(at.slope), 2.0 / size);
    // In texels, whose middles are whole numbers here.
    let middle = (vec2f(0.5, 0.5) + vec2f(0.5, -0.5) * at.place.xy) * size - 0.5;
    let first = floor(middle) - f32(PCF_RADIUS);
    let share = middle - floor(middle);
    var sum = 0.0;
    for (var y = 0; y <= PCF_RADIUS; y++) {
        let row = pair(y, share.y);
        for (var x = 0; x <= PCF_RADIUS; x++) {
            let column = pair(x, share.x);
            let texel = first + vec2f(column.place, row.place);
            let shift = (texel - middle) * vec2f(2.0, -2.0) / size;
            let depth = at.place.z + dot(at.slope, shift) + bias;
            let lit = textureSampleCompareLevel(map, compared, (texel + 0.5) / size, at.face, depth);
            sum += lit * column.weight * row.weight;
        }
    }
    let width = f32(2 * PCF_RADIUS + 1);
    return sum / (width * width);
}

// Two neighbouring texels of a row as one: where between them, in texels from the first of the row, and their weight.
struct Pair {
    place: f32,
    weight: f32,
}

fn pair(index: i32, share: f32) -> Pair {
    let before = select(1.0, 1.0 - share, index == 0);
    let after = select(1.0, share, index == PCF_RADIUS);
    let weight = before + after;
    return Pair(f32(2 * index) + after / weight, weight);
}

fn cube_face(direction: vec3f) -> u32 {
    let size = abs(direction);
    if size.x >= max(size.y, size.z) {
        return select(0u, 1u, direction.x < 0.0);
    }
    if size.y >= size.z {
        return select(2u, 3u, direction.y < 0.0);
    }
    return select(4u, 5u, direction.z < 0.0);
}

// Right, up and ahead as the camera of a face looks.
fn on_face(face: u32, v: vec3f) -> vec3f {
    let s = select(1.0, -1.0, (face & 1u) == 1u);
    let along_x = vec3f(s * v.z, v.y, s * v.x);
    let along_y = vec3f(s * v.x, v.z, s * v.y);
    let along_z = vec3f(-s * v.x, v.y, s * v.z);
    return select(select(along_z, along_y, face < 4u), along_x, face < 2u);
}
