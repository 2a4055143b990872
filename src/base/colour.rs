//! Linear Rec. 709 colour. All computation is linear; sRGB occurs only where textures are decoded and pictures written.

use glam::Vec3;

/// Weights of linear Rec. 709 red, green and blue in luminance Y.
pub const LUMINANCE: Vec3 = Vec3::new(0.2126, 0.7152, 0.0722);

/// Returns the luminance Y of a linear colour, in the unit of its channels.
#[must_use]
pub fn luminance(colour: Vec3) -> f32 {
    colour.dot(LUMINANCE)
}

/// Returns the linear value of an sRGB-encoded channel, both in 0..1.
///
/// Source: IEC 61966-2-1.
#[must_use]
pub fn linear_from_srgb(encoded: f32) -> f32 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// Returns the sRGB encoding of a linear channel, both in 0..1.
#[must_use]
pub fn srgb_from_linear(linear: f32) -> f32 {
    let linear = linear.clamp(0.0, 1.0);
    if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Returns the linear values of all 256 sRGB bytes.
#[must_use]
pub fn srgb_byte_table() -> [f32; 256] {
    std::array::from_fn(|byte| linear_from_srgb(byte as f32 / 255.0))
}

/// Tone map: keeps colours below 0.8 and compresses brighter ones towards white, as shaders/display/tone_map.wgsl does.
///
/// Source: Khronos 2024, "PBR Neutral Tone Mapper", without its offset for Fresnel reflection.
#[must_use]
pub fn neutral(colour: Vec3) -> Vec3 {
    const START: f32 = 0.8;
    const DESATURATION: f32 = 0.15;
    let peak = colour.max_element();
    if peak < START {
        return colour;
    }
    let room = 1.0 - START;
    let new_peak = 1.0 - room * room / (peak + room - START);
    let whitening = 1.0 - 1.0 / (DESATURATION * (peak - new_peak) + 1.0);
    (colour * (new_peak / peak)).lerp(Vec3::splat(new_peak), whitening)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_srgb_round_trip_is_exact_to_a_tenth_of_a_byte() {
        for byte in 0..=255u8 {
            let back = srgb_from_linear(linear_from_srgb(f32::from(byte) / 255.0)) * 255.0;
            assert!((back - f32::from(byte)).abs() < 0.1, "{byte} came back as {back}");
        }
    }

    #[test]
    fn white_has_luminance_one() {
        assert!((luminance(Vec3::ONE) - 1.0).abs() < 1e-6);
    }
}
