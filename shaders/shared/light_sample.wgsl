// One light sample and the irradiance that it brings where nothing stands between. Written by
// src/render/shadow/light_samples.rs, whose formulas are the same.

const LIGHT_POINT: u32 = 0u;
const LIGHT_SPOT: u32 = 1u;
const LIGHT_DIRECTIONAL: u32 = 2u;
// A point of an emissive surface: it shines as the cosine to the normal, on one side.
const LIGHT_SURFACE: u32 = 3u;

// Light that grazes a surface more than this brings nothing worth a decision.
const GRAZING_COSINE: f32 = 1e-4;
const SHORTEST_SQUARE: f32 = 1e-12;

struct LightSample {
    // Homogeneous: a position with w = 1, or the direction towards the light with w = 0.
    place: vec4f,
    // Unit axis of a spot or normal of a surface.
    axis: vec3f,
    kind: u32,
    // Candela per channel, for a directional light lux; dimmed with its group.
    intensity: vec3f,
    // Metres; 0 means without end.
    range: f32,
    // share = (cosine to the axis x scale + offset), clamped and squared.
    cone_scale: f32,
    cone_offset: f32,
    padding: vec2f,
}

@group(1) @binding(0) var<storage, read> light: LightSample;

fn irradiance(point: vec3f, normal: vec3f) -> vec3f {
    let offset = light.place.xyz - light.place.w * point;
    let square = max(dot(offset, offset), SHORTEST_SQUARE);
    let to_light = offset * inverseSqrt(square);
    let cosine = dot(normal, to_light);
    if cosine <= GRAZING_COSINE {
        return vec3f(0.0);
    }
    return light.intensity * (cosine * emitted_share(to_light) * falloff(square));
}

fn emitted_share(to_light: vec3f) -> f32 {
    let cosine = dot(-to_light, light.axis);
    switch light.kind {
        case LIGHT_SPOT: {
            let share = saturate(cosine * light.cone_scale + light.cone_offset);
            return share * share;
        }
        case LIGHT_SURFACE: {
            return select(0.0, cosine, cosine > GRAZING_COSINE);
        }
        default: {
            return 1.0;
        }
    }
}

fn falloff(square: f32) -> f32 {
    if light.kind == LIGHT_DIRECTIONAL {
        return 1.0;
    }
    if light.range <= 0.0 {
        return 1.0 / square;
    }
    let share = square / (light.range * light.range);
    return saturate(1.0 - share * share) / square;
}
