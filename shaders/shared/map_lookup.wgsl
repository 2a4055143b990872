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
    // Texels across and down a face, and 1 over it.
    resolution: f32,
    inverse_resolution: f32,
    // Shift of a point along its normal, texels.
    normal_offset: f32,
    // Shift towards the light: as deep as the surface falls over so many texels.
    slope_bias: f32,
    padding: f32,
    // The least that a surface is taken to fall over a texel: of all depths, and as a share of the depth.
    rounding: vec2f,
}

// Texels each way over which shadows are softened.
override PCF_RADIUS: i32 = 1;
// Points are shifted along their normal.
override HAS_NORMAL_OFFSET: bool = true;

// Share of a light sample that its map lets through to a point; the map has six faces round the light, in the order
// +X -X +Y -Y +Z -Z, or one for a spot or a directional light.
fn seen_share(
    light: LightSample,
    arrival: Arrival,
    shadow_map: ShadowMap,
    depth: texture_depth_2d_array,
    gathered: sampler,
    is_cube: bool,
    point: vec3f,
    facet: vec3f
) -> f32 {
    let cosine = dot(facet, arrival.to_light);
    var shifted = point;
    if HAS_NORMAL_OFFSET {
        shifted += normal_offset(light, arrival, shadow_map, cosine) * facet;
    }
    var at: MapPoint;
    if is_cube {
        at = in_cube(shadow_map, shifted - light.place.xyz, facet);
    } else {
        at = in_map(shadow_map, shifted, facet);
    }
    // A smooth normal may see light that the triangle itself turns its back on.
    return select(0.0, lit_share(shadow_map, depth, gathered, at), cosine > 0.0);
}

// Away from the surface, the more the flatter the light falls on it, metres.
fn normal_offset(light: LightSample, arrival: Arrival, shadow_map: ShadowMap, cosine: f32) -> f32 {
    let along_axes = abs(arrival.to_light) / arrival.inverse_distance;
    let axis_distance = max(along_axes.x, max(along_axes.y, along_axes.z));
    let texel = shadow_map.texel * select(1.0, axis_distance, light.place.w > 0.0);
    return texel * shadow_map.normal_offset * sqrt(saturate(1.0 - cosine * cosine));
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
    return MapPoint(0u, clip.xyz * (1.0 / clip.w), flat(-plane.xy, plane.z));
}

// The faces of the cube lie along the axes: to look through one is to change the order and signs of coordinates.
fn in_cube(shadow_map: ShadowMap, from_light: vec3f, facet: vec3f) -> MapPoint {
    let face = cube_face(from_light);
    let seen = on_face(face, from_light);
    let normal = on_face(face, facet);
    let distance = dot(normal, seen);
    let place = vec3f(seen.xy / shadow_map.half_width, shadow_map.near) * (1.0 / seen.z);
    return MapPoint(face, place, flat(normal.xy * (shadow_map.near * shadow_map.half_width), distance));
}

// A surface seen edge on from the light has no slope to speak of.
fn flat(slope: vec2f, divisor: f32) -> vec2f {
    return slope * select(1.0 / divisor, 0.0, divisor == 0.0);
}

// Mean over the texels round a point, each compared with the depth of the surface in its middle. Of the texels in a row,
// the first and the last count by the share that the window covers of them.
fn lit_share(shadow_map: ShadowMap, map: texture_depth_2d_array, gathered: sampler, at: MapPoint) -> f32 {
    // Change of depth from texel to texel.
    let fall = at.slope * vec2f(2.0, -2.0) * shadow_map.inverse_resolution;
    let least = shadow_map.rounding.x + shadow_map.rounding.y * at.place.z;
    let depth = at.place.z + shadow_map.slope_bias * (abs(fall.x) + abs(fall.y) + least);
    // In texels, whose middles are whole numbers here.
    let middle = (vec2f(0.5, 0.5) + vec2f(0.5, -0.5) * at.place.xy) * shadow_map.resolution - 0.5;
    let share = middle - floor(middle);
    var sum = 0.0;
    for (var y = 0; y <= PCF_RADIUS; y++) {
        for (var x = 0; x <= PCF_RADIUS; x++) {
            // Two by two, first those below.
            let first = vec2f(vec2i(2 * x, 2 * y) - PCF_RADIUS);
            let corner = (floor(middle) + first + 1.0) * shadow_map.inverse_resolution;
            let stored = textureGather(map, gathered, corner, at.face);
            let offset = first - share;
            let right = offset.x + vec4f(0.0, 1.0, 1.0, 0.0);
            let down = offset.y + vec4f(1.0, 1.0, 0.0, 0.0);
            let surface = depth + fall.x * right + fall.y * down;
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
