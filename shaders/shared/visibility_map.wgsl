// What the shadow map sees is lit. Written by src/render/shadow/map_projection.rs.

struct ShadowMap {
    // One for a spot or a directional light; six for a point, in the order +X -X +Y -Y +Z -Z.
    projection_from_world: array<mat4x4f, 6>,
    num_faces: u32,
    // Width of a texel, metres; for perspective maps at one metre from the light.
    texel: f32,
    // Shift of a point along its normal, texels.
    normal_offset: f32,
    // Shift towards the light: as deep as the surface falls over so many texels.
    slope_bias: f32,
    // Texels each way over which shadows are softened.
    pcf_radius: i32,
    padding: vec3u,
}

@group(2) @binding(0) var<storage, read> shadow_map: ShadowMap;
@group(2) @binding(1) var map_depth: texture_depth_2d_array;
@group(2) @binding(2) var map_sampler: sampler_comparison;

// A surface seen edge on from the light has no slope to speak of.
const SMALLEST_AREA: f32 = 1e-12;

fn visibility(point: vec3f, facet: vec3f) -> f32 {
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
    let face = select(0u, cube_face(shifted - light.place.xyz), shadow_map.num_faces == 6u);
    let seen = in_map(face, shifted);
    return lit_share(seen, face, depth_slope(face, shifted, seen, facet, texel));
}

// Place in the map: -1..1 across and up, and depth.
fn in_map(face: u32, point: vec3f) -> vec3f {
    let clip = shadow_map.projection_from_world[face] * vec4f(point, 1.0);
    return clip.xyz / clip.w;
}

// Change of depth across and up the map along the plane of the surface; depth is linear there.
fn depth_slope(face: u32, point: vec3f, seen: vec3f, facet: vec3f, texel: f32) -> vec2f {
    let across = normalize(cross(facet, select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), abs(facet.x) > 0.7)));
    let a = in_map(face, point + texel * across) - seen;
    let b = in_map(face, point + texel * cross(facet, across)) - seen;
    let determinant = a.x * b.y - a.y * b.x;
    if abs(determinant) < SMALLEST_AREA {
        return vec2f(0.0);
    }
    return vec2f(b.y * a.z - a.y * b.z, a.x * b.z - b.x * a.z) / determinant;
}

// Mean over the texels round `seen`, each compared with the depth of the surface there; each comparison is interpolated
// between four, whose spread the bias covers.
fn lit_share(seen: vec3f, face: u32, slope: vec2f) -> f32 {
    let step = 2.0 / vec2f(textureDimensions(map_depth));
    let bias = shadow_map.slope_bias * dot(abs(slope), step);
    let radius = shadow_map.pcf_radius;
    var sum = 0.0;
    for (var y = -radius; y <= radius; y++) {
        for (var x = -radius; x <= radius; x++) {
            let shift = vec2f(f32(x), f32(y)) * step;
            let uv = vec2f(0.5, 0.5) + vec2f(0.5, -0.5) * (seen.xy + shift);
            sum += textureSampleCompareLevel(map_depth, map_sampler, uv, face, seen.z + dot(slope, shift) + bias);
        }
    }
    let width = f32(2 * radius + 1);
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
