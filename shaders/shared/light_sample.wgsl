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

// How light arrives at a point.
struct Arrival {
    // Unit.
    to_light: vec3f,
    // 1 / m.
    inverse_distance: f32,
}

fn arrival(light: LightSample, point: vec3f) -> Arrival {
    let offset = light.place.xyz - light.place.w * point;
    let inverse_distance = inverseSqrt(max(dot(offset, offset), SHORTEST_SQUARE));
    return Arrival(offset * inverse_distance, inverse_distance);
}

fn irradiance(light: LightSample, arrival: Arrival, normal: vec3f) -> vec3f {
    let cosine = dot(normal, arrival.to_light);
    let share = cosine * emitted_share(light, arrival.to_light) * falloff(light, arrival.inverse_distance);
    return light.intensity * select(0.0, share, cosine > GRAZING_COSINE);
}

fn emitted_share(light: LightSample, to_light: vec3f) -> f32 {
    let cosine = dot(-to_light, light.axis);
    let in_cone = saturate(cosine * light.cone_scale + light.cone_offset);
    let from_surface = select(0.0, cosine, cosine > GRAZING_COSINE);
    return select(in_cone * in_cone, from_surface, light.is_surface > 0.0);
}

fn falloff(light: LightSample, inverse_distance: f32) -> f32 {
    let inverse_square = inverse_distance * inverse_distance;
    let share = light.inverse_square_range / inverse_square;
    return select(1.0, saturate(1.0 - share * share) * inverse_square, light.place.w > 0.0);
}
