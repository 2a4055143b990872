//! Reads the decisions of a technique back: is a light sample visible from a pixel?

use crate::gpu::readback::{f32_from_half, read_stencil, read_texture};
use crate::gpu::{Gpu, GpuError};
use crate::render::shadow::light::direct_light;
use crate::render::shadow::light::targets::LightTargets;
use crate::render::shadow::real_time::RealTimeLight;
use crate::render::shadow::settings::ShadowSettings;
use crate::render::shadow::shared::frame_context::FrameContext;

/// Which light samples are visible from which pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Decisions {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Decisions about each light sample `[sample]`.
    pub samples: Vec<SampleDecisions>,
}

/// Decisions of a technique about one light sample.
#[derive(Clone, Debug, PartialEq)]
pub struct SampleDecisions {
    /// True if the light sample is visible from the pixel, `[pixel]`.
    pub lit: Vec<bool>,
    /// True if the technique decides about the pixel, `[pixel]`; `None` if it decides about all pixels.
    pub claimed: Option<Vec<bool>>,
}

/// Returns the decisions of a technique about all light samples. `light` must draw one sample a pixel.
///
/// # Errors
/// Returns an error if the device was lost.
pub fn decisions(
    light: &mut RealTimeLight,
    frame: FrameContext<'_>,
    settings: &ShadowSettings,
) -> Result<Vec<SampleDecisions>, GpuError> {
    assert_eq!(light.samples_per_pixel(), 1, "decisions are read pixel by pixel");
    let gpu = frame.gpu;
    if let Some(rays) = light.rays(gpu, settings.technique) {
        let lit = rays.decisions(frame, &settings.samples(frame.shadows))?;
        return Ok(lit.into_iter().map(|lit| SampleDecisions { lit, claimed: None }).collect());
    }
    let run = light.prepare(frame, settings);
    let mut decisions = Vec::with_capacity(run.samples.len());
    for index in 0..run.samples.len() {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        light.draw_depth(&mut encoder, &run);
        direct_light::clear(&mut encoder, &run.targets);
        light.mark_shadows(&mut encoder, &run, index);
        light.add_light(&mut encoder, &run, index);
        gpu.queue.submit([encoder.finish()]);
        let lit = lit_pixels(gpu, &run.targets)?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let is_limited = light.light_receivers(&mut encoder, &run, index);
        gpu.queue.submit([encoder.finish()]);
        let claimed = is_limited.then(|| lit_pixels(gpu, &run.targets)).transpose()?;
        decisions.push(SampleDecisions { lit, claimed });
    }
    light.keep_targets(run);
    Ok(decisions)
}

/// Returns the stencil after the shadows of light sample `index`, one byte a pixel. `light` must draw one sample a
/// pixel.
///
/// # Errors
/// Returns an error if the device was lost.
pub fn stencil(
    light: &mut RealTimeLight,
    frame: FrameContext<'_>,
    settings: &ShadowSettings,
    index: usize,
) -> Result<Vec<u8>, GpuError> {
    let run = light.prepare(frame, settings);
    let mut encoder = frame.gpu.device.create_command_encoder(&Default::default());
    light.draw_depth(&mut encoder, &run);
    light.mark_shadows(&mut encoder, &run, index);
    frame.gpu.queue.submit([encoder.finish()]);
    let stencil = read_stencil(frame.gpu, &run.targets.depth_stencil_texture);
    light.keep_targets(run);
    stencil
}

/// Returns true for each pixel from which at least half of the light sample is visible.
fn lit_pixels(gpu: &Gpu, targets: &LightTargets) -> Result<Vec<bool>, GpuError> {
    if targets.irradiance.format() == wgpu::TextureFormat::Rgba32Float {
        let bytes = read_texture(gpu, &targets.irradiance, 16)?;
        let visible = |pixel: &[u8; 16]| f32::from_le_bytes([pixel[12], pixel[13], pixel[14], pixel[15]]);
        return Ok(bytes.as_chunks().0.iter().map(|pixel| visible(pixel) >= 0.5).collect());
    }
    let bytes = read_texture(gpu, &targets.irradiance, 8)?;
    let visible = |pixel: &[u8; 8]| f32_from_half(u16::from_le_bytes([pixel[6], pixel[7]]));
    Ok(bytes.as_chunks().0.iter().map(|pixel| visible(pixel) >= 0.5).collect())
}
