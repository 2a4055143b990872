// Converts radiance to display colours: tone curve, sRGB encoding, dither.

const TONE_MAP_NEUTRAL: u32 = 0u;
const TONE_MAP_LINEAR: u32 = 1u;
// True if the format of the target encodes sRGB itself.
override TARGET_ENCODES: bool = false;

// Returns the value of the target for a linear display colour.
fn displayed(colour: vec3f, pixel: vec2f) -> vec4f {
    let encoded = srgb_from_linear(saturate(colour));
    // Noise of half a step hides the steps of eight bits. A colour that is exactly one of these steps stays unchanged.
    let dithered = saturate(encoded + gradient_noise(pixel) / 255.0);
    return vec4f(select(dithered, linear_from_srgb(dithered), TARGET_ENCODES), 1.0);
}

// Returns the linear display colour of exposed light.
fn tone_mapped(exposed: vec3f, tone_map: u32) -> vec3f {
    if tone_map == TONE_MAP_LINEAR {
        return saturate(exposed);
    }
    return neutral(exposed);
}

// Khronos PBR Neutral tone mapper (Khronos 2024). Colours with the largest channel p < 0.8 are unchanged; else
//   p' = 1 - 0.2^2 / (p - 0.6),   colour' = mix(colour p' / p, p', 1 - 1 / (1 + 0.15 (p - p'))),
// which compresses highlights towards white without a change of hue. The specification also subtracts an offset for the
// 4 % that a dielectric mirrors. It is left out here, because these surfaces are diffuse.
fn neutral(colour: vec3f) -> vec3f {
    const START: f32 = 0.8;
    const DESATURATION: f32 = 0.15;
    let peak = max(colour.r, max(colour.g, colour.b));
    if peak < START {
        return colour;
    }
    // p' = numerator / over, and the share of white is 1 - over / divisor. The formulas are combined to save divisions,
    // which are slow on a software driver.
    let room = 1.0 - START;
    let over = peak + room - START;
    let numerator = over - room * room;
    let loss = peak * over - numerator;
    let divisor = over + DESATURATION * loss;
    return (colour * over + DESATURATION * loss * peak) * (numerator / (peak * over)) * (1.0 / divisor);
}

// Returns interleaved gradient noise (Jimenez 2014, "Next Generation Post Processing in Call of Duty"). Its range is
// -0.49..0.49, slightly less than half a step, so that rounding restores whole steps.
fn gradient_noise(pixel: vec2f) -> f32 {
    return fract(52.9829189 * fract(dot(floor(pixel), vec2f(0.06711056, 0.00583715)))) * 0.98 - 0.49;
}
