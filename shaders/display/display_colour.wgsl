// From radiance to what the screen shows.

const TONE_MAP_NEUTRAL: u32 = 0u;
const TONE_MAP_LINEAR: u32 = 1u;
// The target's format encodes sRGB itself.
override TARGET_ENCODES: bool = false;

// What a pixel of the target holds of a linear display colour.
fn displayed(colour: vec3f, pixel: vec2f) -> vec4f {
    let encoded = srgb_from_linear(saturate(colour));
    // Half a step of noise hides the steps of eight bits; a colour that is a step itself stays as it is.
    let dithered = saturate(encoded + gradient_noise(pixel) / 255.0);
    return vec4f(select(dithered, linear_from_srgb(dithered), TARGET_ENCODES), 1.0);
}

// Linear display colour of exposed light.
fn tone_mapped(exposed: vec3f, tone_map: u32) -> vec3f {
    if tone_map == TONE_MAP_LINEAR {
        return saturate(exposed);
    }
    return neutral(exposed);
}

// Khronos PBR Neutral tone mapper (Khronos 2024), without the offset that takes away 4 % of mirror reflection: these
// surfaces are diffuse and reflect none.
fn neutral(colour: vec3f) -> vec3f {
    const START: f32 = 0.8;
    const DESATURATION: f32 = 0.15;
    let peak = max(colour.r, max(colour.g, colour.b));
    if peak < START {
        return colour;
    }
    // The new peak is numerator / over, the share of white 1 - over / divisor: brought to two quotients, for which software
    // drivers take long.
    let room = 1.0 - START;
    let over = peak + room - START;
    let numerator = over - room * room;
    let loss = peak * over - numerator;
    let divisor = over + DESATURATION * loss;
    return (colour * over + DESATURATION * loss * peak) * (numerator / (peak * over)) * (1.0 / divisor);
}

// Interleaved gradient noise in -0.49..0.49: a hair less than half, so that rounding brings a whole step back
// (Jimenez 2014, "Next Generation Post Processing in Call of Duty").
fn gradient_noise(pixel: vec2f) -> f32 {
    return fract(52.9829189 * fract(dot(floor(pixel), vec2f(0.06711056, 0.00583715)))) * 0.98 - 0.49;
}
