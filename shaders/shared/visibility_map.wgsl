// What the shadow map sees is lit. Written by src/render/shadow/shadow_map.rs.

struct ShadowMap {
    // One for a spot or a directional light; six for a point, in the order +X -X +Y -Y +Z -Z.
    projection_from_world: array<mat4x4f, 6>,
    num_faces: u32,
    // Width of a texel, metres; for perspective maps at one metre from the light.
    texel: f32,
    // Shift of a point along its normal, texels.
    normal_offset: f32,
    // Shift towards the light, texels.
    slope_bias: f32,
    // Texels each way over which shadows are softened.
    pcf_radius: i32,
    padding: vec3u,
}

@group(2) @binding(0) var<uniform> shadow_map: ShadowMap;
@group(2) @binding(1) var map_depth: texture_depth_2d_array;
@group(2) @binding(2) var map_sampler: sampler_comparison;

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
    // Away from the surface, the more the flatter the light falls on it, and towards the light.
    let slope = sqrt(saturate(1.0 - cosine * cosine));
    let shifted = point + texel * (shadow_map.normal_offset * slope * facet + shadow_map.slope_bias * to_light);
    let face = select(0u, cube_face(shifted - light.place.xyz), shadow_map.num_faces == 6u);
    let clip = shadow_map.projection_from_world[face] * vec4f(shifted, 1.0);
    let ndc = clip.xyz / clip.w;
    let uv = vec2f(0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y);
    return lit_share(uv, face, ndc.z);
}

// Mean over the texels round `uv`; each comparison is interpolated between four.
fn lit_share(uv: vec2f, face: u32, depth: f32) -> f32 {
    let size = vec2f(textureDimensions(map_depth));
    let radius = shadow_map.pcf_radius;
    var sum = 0.0;
    for (var y = -radius; y <= radius; y++) {
        for (var x = -radius; x <= radius; x++) {
            let at = uv + vec2f(f32(x), f32(y)) / size;
            sum += textureSampleCompareLevel(map_depth, map_sampler, at, face, depth);
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
