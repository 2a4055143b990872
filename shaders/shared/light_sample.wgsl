// A light sample and the irradiance that it brings where nothing stands between. Written by
// src/render/shadow/light_samples.rs, whose formulas are the same.

// Light that grazes a surface more than this brings nothing worth a decision.
const GRAZING_COSINE: f32 = 1e-4;
const SHORTEST_SQUARE: f32 = 1e-12;

struct LightSample {
    // Homogeneous: a position with w = 1, or the direction towards the light with w = 0.
    place: vec4f,
    // Unit axis of a spot or normal of a surface.
    axis: vec3f,
    // 1 for a point of an emissive surface, which shines as the cosine to the normal, on one side.
    is_surface: f32,
    // Candela per channel, for a directional light lux; dimmed with its group.
    intensity: vec3f,
    // 1 over the square of metres; 0 means without end.
    inverse_square_range: f32,
    // share = (cosine to the axis x scale + offset), clamped and squared; 0 and 1 where there is no cone.
    cone_scale: f32,
    cone_offset: f32,
    padding: vec2f,
}

fn irradiance(light: LightSample, point: vec3f, normal: vec3f) -> vec3f {
    let offset = light.place.xyz - light.place.w * point;
    let square = max(dot(offset, offset), SHORTEST_SQUARE);
    let to_light = offset * inverseSqrt(square);
    let cosine = dot(normal, to_light);
    if cosine <= GRAZING_COSINE {
        return vec3f(0.0);
    }
    return light.intensity * (cosine * emitted_share(light, to_light) * falloff(light, square));
}

fn emitted_share(light: LightSample, to_light: vec3f) -> f32 {
    let cosine = dot(-to_light, light.axis);
    let in_cone = saturate(cosine * light.cone_scale + light.cone_offset);
    let from_surface = select(0.0, cosine, cosine > GRAZING_COSINE);
    return select(in_cone * in_cone, from_surface, light.is_surface > 0.0);
}

fn falloff(light: LightSample, square: f32) -> f32 {
    let share = square * light.inverse_square_range;
    return select(1.0, saturate(1.0 - share * share) / square, light.place.w > 0.0);
}
