// A light sample and its unshadowed irradiance. The uniform is written by src/render/shadow/light/uniforms.rs; the
// formulas are those of src/render/shadow/light/sample.rs.

// Light at a lower cosine counts as zero. So nearly edge-on surfaces are dark whatever a technique decides about them.
const GRAZING_COSINE: f32 = 1e-4;
const SHORTEST_SQUARE: f32 = 1e-12;

// Bit of `kind`: the light is directional.
const IS_PARALLEL: u32 = 1u;
// Bit of `kind`: the sample is a point of an emissive surface. It emits on one side, in proportion to the cosine to the
// normal.
const IS_SURFACE: u32 = 2u;
// Bit of `kind`: the light is a spot light.
const HAS_CONE: u32 = 4u;
// Bit of `kind`: the light has a glTF `range`.
const HAS_RANGE: u32 = 8u;
// Bit of `kind`: the light is far from the scene, and the origin of light space is that of the world. With the origin
// at the light, differences between neighbouring pixels would be lost to rounding.
const IS_FAR: u32 = 16u;

struct LightSample {
    // Homogeneous: a point with w = 1, or the direction towards the light with w = 0.
    position: vec4f,
    // Axes of light space, in which the light is a camera: right, up, and backwards.
    right: vec3f,
    kind: u32,
    up: vec3f,
    // 1 / range^2, in 1 / m^2.
    inverse_square_range: f32,
    back: vec3f,
    // Fraction of the intensity inside the cone of a spot: saturate(cosine x cone_scale + cone_offset)^2, as in
    // KHR_lights_punctual.
    cone_scale: f32,
    // Candela per channel, or lux for a directional light. Dimmed with its group and scaled by pre-exposure.
    intensity: vec3f,
    cone_offset: f32,
    // Vector from the light to the origin of light space, for far lights.
    to_origin: vec3f,
    padding: f32,
}

// A visible point in light space.
struct Receiver {
    // Vector from the light to the point, metres; for a directional light, from the origin of light space.
    from_light: vec3f,
    // Vector along the normal of its triangle on the visible side, of any length.
    facet: vec3f,
    // Unit shading normal.
    normal: vec3f,
}

fn in_light_space(light: LightSample, v: vec3f) -> vec3f {
    return vec3f(dot(light.right, v), dot(light.up, v), dot(light.back, v));
}

// Converts a point of the world to light space.
fn position_in_light_space(light: LightSample, point: vec3f) -> vec3f {
    return in_light_space(light, point - select(light.position.w, 0.0, has(light.kind, IS_FAR)) * light.position.xyz);
}

// Returns the vector from the light to a point of light space, metres.
fn from_light(light: LightSample, kind: u32, point: vec3f) -> vec3f {
    return point + select(vec3f(0.0), light.to_origin, has(kind, IS_FAR));
}

// Direction and distance of the light at a point.
struct Arrival {
    // Unit vector towards the light.
    to_light: vec3f,
    // 1 / distance, 1 / m.
    inverse_distance: f32,
}

fn arrival(kind: u32, from_light: vec3f) -> Arrival {
    let inverse_distance = inverseSqrt(max(dot(from_light, from_light), SHORTEST_SQUARE));
    let to_light = select(-from_light * inverse_distance, vec3f(0.0, 0.0, 1.0), has(kind, IS_PARALLEL));
    return Arrival(to_light, inverse_distance);
}

// Returns the unshadowed irradiance, scaled by pre-exposure: E = I cos / r^2. `kind` is that of the light. If a
// pipeline passes it as a constant, the compiler removes the loads of properties that the light lacks.
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
