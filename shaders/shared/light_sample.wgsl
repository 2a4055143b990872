// A light sample and the irradiance that it brings where nothing stands between. Written by
// src/render/shadow/light_samples.rs, whose formulas are the same.

// Light that grazes a surface more than this brings nothing worth a decision.
const GRAZING_COSINE: f32 = 1e-4;
const SHORTEST_SQUARE: f32 = 1e-12;

// Bits of `kind`.
const IS_PARALLEL: u32 = 1u;
// A point of an emissive surface, which shines as the cosine to its normal, on one side.
const IS_SURFACE: u32 = 2u;
const HAS_CONE: u32 = 4u;
const HAS_RANGE: u32 = 8u;
// Light space begins not at the light, from where neighbouring points would all look the same, but at the origin.
const IS_FAR: u32 = 16u;

struct LightSample {
    // Homogeneous: a position with w = 1, or the direction towards the light with w = 0.
    place: vec4f,
    // Axes of light space, in which the light looks as a camera does: right, up, and back along its own axis.
    right: vec3f,
    kind: u32,
    up: vec3f,
    // 1 over the square of metres.
    inverse_square_range: f32,
    back: vec3f,
    // share = (cosine to the axis x scale + offset), clamped and squared.
    cone_scale: f32,
    // Candela per channel, for a directional light lux; dimmed with its group, scaled by pre-exposure.
    intensity: vec3f,
    cone_offset: f32,
    // From the light to the origin of light space, for lights that are far.
    to_origin: vec3f,
    padding: f32,
}

// A visible point, in light space.
struct Receiver {
    // Metres from the light; where light is parallel, from the origin.
    from_light: vec3f,
    // Along the normal of its triangle, on the side that is seen.
    facet: vec3f,
    // Unit shading normal.
    normal: vec3f,
}

fn in_light_space(light: LightSample, v: vec3f) -> vec3f {
    return vec3f(dot(light.right, v), dot(light.up, v), dot(light.back, v));
}

// A place of the world.
fn place_in_light_space(light: LightSample, point: vec3f) -> vec3f {
    return in_light_space(light, point - select(light.place.w, 0.0, has(light.kind, IS_FAR)) * light.place.xyz);
}

// Metres from the light to a place in light space.
fn from_light(light: LightSample, kind: u32, place: vec3f) -> vec3f {
    return place + select(vec3f(0.0), light.to_origin, has(kind, IS_FAR));
}

// How light arrives at a point.
struct Arrival {
    // Unit.
    to_light: vec3f,
    // 1 / m.
    inverse_distance: f32,
}

fn arrival(kind: u32, from_light: vec3f) -> Arrival {
    let inverse_distance = inverseSqrt(max(dot(from_light, from_light), SHORTEST_SQUARE));
    let to_light = select(-from_light * inverse_distance, vec3f(0.0, 0.0, 1.0), has(kind, IS_PARALLEL));
    return Arrival(to_light, inverse_distance);
}

// Scaled by pre-exposure. `kind` is that of the light, where it is known when a pipeline is made: what a light does not have
// is not even loaded.
fn irradiance(light: LightSample, kind: u32, arrival: Arrival, normal: vec3f) -> vec3f {
    let cosine = dot(normal, arrival.to_light);
    let share = cosine * emitted_share(light, kind, arrival.to_light) * falloff(light, kind, arrival.inverse_distance);
    return light.intensity * select(0.0, share, cosine > GRAZING_COSINE);
}

fn emitted_share(light: LightSample, kind: u32, to_light: vec3f) -> f32 {
    let cosine = to_light.z;
    let in_cone = saturate(cosine * light.cone_scale + light.cone_offset);
    let from_surface = select(0.0, cosine, cosine > GRAZING_COSINE);
    return select(select(1.0, in_cone * in_cone, has(kind, HAS_CONE)), from_surface, has(kind, IS_SURFACE));
}

fn falloff(light: LightSample, kind: u32, inverse_distance: f32) -> f32 {
    let inverse_square = inverse_distance * inverse_distance;
    let share = light.inverse_square_range / inverse_square;
    let in_range = select(1.0, saturate(1.0 - share * share), has(kind, HAS_RANGE));
    return select(in_range * inverse_square, 1.0, has(kind, IS_PARALLEL));
}

fn has(kind: u32, bit: u32) -> bool {
    return (kind & bit) != 0u;
}
