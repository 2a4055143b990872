//! Exposure and tone mapping on the CPU, for ray-traced pictures.
//!
//! The formulas are those of `shaders/display/light_meter.wgsl` and `shaders/display/tone_map.wgsl`; a test compares
//! the results. The exposure is
//!
//! ```text
//! exposure = min(0.2 / exp2(mean of log2 L), 1.5 / L at the 95th percentile)
//! ```
//!
//! It places the log-average luminance at middle grey (Reinhard et al. 2002, "Photographic Tone Reproduction for
//! Digital Images", eq. 1), unless the brightest twentieth of the pixels would then exceed one and a half times white.

use glam::Vec3;

use crate::base::colour::{luminance, neutral, srgb_from_linear};
use crate::render::{Picture, RenderSettings, ToneMap};

/// The constants of shaders/display/light_meter.wgsl.
const NUM_BINS: usize = 256;
const STEP: usize = 2;
const DARKEST: f32 = -20.0;
const BINS_PER_STOP: f32 = 6.4;
const MIDDLE_GREY: f32 = 0.2;
const HIGHLIGHT_SHARE: f32 = 0.95;
const HIGHLIGHT: f32 = 1.5;

/// Returns a picture of `size` pixels. `radiance` is linear and not yet exposed. It is premultiplied by its fourth
/// channel, the covered share of the pixel.
#[must_use]
pub fn tone_map_on_cpu(size: [u32; 2], radiance: Vec<[f32; 4]>, settings: &RenderSettings) -> Picture {
    let exposure = settings.fixed_exposure().unwrap_or_else(|| metered(size, &radiance));
    let display = |(number, &pixel): (usize, &[f32; 4])| {
        let at = [number as u32 % size[0], number as u32 / size[0]];
        display_bytes(pixel, at, exposure, settings)
    };
    let display = radiance.iter().enumerate().flat_map(display).collect();
    Picture { width: size[0], height: size[1], radiance, display }
}

/// Returns the metered exposure, a factor on radiance.
fn metered(size: [u32; 2], radiance: &[[f32; 4]]) -> f32 {
    let histogram = histogram(size[0] as usize, radiance);
    let counted = || histogram.iter().enumerate().skip(1);
    let total: u32 = counted().map(|(_, &pixels)| pixels).sum();
    if total == 0 {
        return 1.0;
    }
    let log_sum: f32 = counted().map(|(bin, &pixels)| pixels as f32 * log2_of_bin(bin)).sum();
    let mut below = 0.0;
    let bright = counted().find(|&(_, &pixels)| {
        below += pixels as f32;
        below >= HIGHLIGHT_SHARE * total as f32
    });
    let highlight = log2_of_bin(bright.map_or(NUM_BINS - 1, |(bin, _)| bin)).exp2();
    (MIDDLE_GREY / (log_sum / total as f32).exp2()).min(HIGHLIGHT / highlight)
}

/// Returns the histogram of log2 luminance over every other pixel of every other row. Bin 0 counts the dark pixels.
fn histogram(width: usize, radiance: &[[f32; 4]]) -> [u32; NUM_BINS] {
    let mut bins = [0; NUM_BINS];
    for row in radiance.chunks(width).step_by(STEP) {
        for &[r, g, b, coverage] in row.iter().step_by(STEP).filter(|pixel| pixel[3] > 0.5) {
            let value = luminance(Vec3::new(r, g, b)) / coverage;
            let bin = (value.max(1e-30).log2() - DARKEST) * BINS_PER_STOP;
            bins[bin.clamp(0.0, NUM_BINS as f32 - 1.0) as usize] += 1;
        }
    }
    bins
}

fn log2_of_bin(bin: usize) -> f32 {
    (bin as f32 + 0.5) / BINS_PER_STOP + DARKEST
}

/// Returns the RGBA bytes of a pixel: exposure, tone curve, background, sRGB encoding, dither.
fn display_bytes([r, g, b, coverage]: [f32; 4], at: [u32; 2], exposure: f32, settings: &RenderSettings) -> [u8; 4] {
    let exposed = Vec3::new(r, g, b) * exposure;
    let toned = match settings.tone_map_in_force() {
        ToneMap::Linear => exposed.clamp(Vec3::ZERO, Vec3::ONE),
        ToneMap::Neutral => neutral(exposed),
    };
    let shown = toned + (1.0 - coverage) * settings.background;
    let noise = gradient_noise(at);
    let byte = |channel: f32| (srgb_from_linear(channel) * 255.0 + noise).round() as u8;
    [byte(shown.x), byte(shown.y), byte(shown.z), 255]
}

/// Returns interleaved gradient noise in -0.49..0.49, as in shaders/display/display_colour.wgsl.
fn gradient_noise([x, y]: [u32; 2]) -> f32 {
    let pattern = (x as f32 * 0.067_110_56 + y as f32 * 0.005_837_15).fract();
    (52.982_92 * pattern).fract() * 0.98 - 0.49
}
