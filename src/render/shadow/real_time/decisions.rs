//! What a technique decides, read back pixel by pixel: for comparison, and for tests.

use super::{RealTimeLight, Subject};
use crate::gpu::readback::f32_from_half;
use crate::gpu::readback::{read_stencil, read_texture};
use crate::gpu::{Gpu, GpuError};
use crate::render::shadow::light_targets::LightTargets;
use crate::render::shadow::light_uniforms::LightUniforms;
use crate::render::shadow::{ShadowSettings, ShadowTechnique, direct_light};

/// What a technique decides about one light sample, pixel by pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct SampleDecisions {
    /// The sample is seen.
    pub lit: Vec<bool>,
    /// The technique claims to know; none claims everything.
    pub claimed: Option<Vec<bool>>,
}

impl RealTimeLight {
    /// Which pixels each light sample lights; for passes with one sample a pixel.
    ///
    /// # Errors
    /// The device was lost.
    pub fn decisions(
        &mut self,
        gpu: &Gpu,
        size: [u32; 2],
        subject: Subject<'_>,
        settings: &ShadowSettings,
    ) -> Result<Vec<SampleDecisions>, GpuError> {
        assert_eq!(self.samples, 1, "decisions are taken pixel by pixel");
        let samples = settings.samples(subject.shadows);
        if settings.technique == ShadowTechnique::Raytraced {
            let lit = self.raytraced.decisions(gpu, size, subject, &samples)?;
            return Ok(lit.into_iter().map(|lit| SampleDecisions { lit, claimed: None }).collect());
        }
        let targets = self.targets_of(gpu, size);
        let lights = LightUniforms::new(gpu, &self.sample_layout, &samples, subject);
        self.prepare(gpu, subject, &samples, settings);
        let mut decisions = Vec::with_capacity(samples.len());
        for (index, sample) in samples.iter().enumerate() {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            self.prepass.draw(&mut encoder, &targets, subject.frame, subject.seen, subject.settings);
            direct_light::clear(&mut encoder, &targets);
            self.add_sample(gpu, &mut encoder, &targets, subject, settings, &lights, (index, sample));
            gpu.queue.submit([encoder.finish()]);
            let lit = lit_pixels(gpu, &targets)?;
            let is_planar = settings.technique == ShadowTechnique::Planar;
            let claimed = is_planar.then(|| self.receivers(gpu, &targets, subject, &lights, index)).transpose()?;
            decisions.push(SampleDecisions { lit, claimed });
        }
        self.targets = Some(targets);
        Ok(decisions)
    }

    /// What the stencil holds after the shadows of one light sample, a byte a pixel; for passes with one sample a pixel.
    ///
    /// # Errors
    /// The device was lost.
    pub fn stencil(
        &mut self,
        gpu: &Gpu,
        size: [u32; 2],
        subject: Subject<'_>,
        settings: &ShadowSettings,
        index: usize,
    ) -> Result<Vec<u8>, GpuError> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let targets = self.mark(gpu, &mut encoder, size, subject, settings, index);
        gpu.queue.submit([encoder.finish()]);
        let stencil = read_stencil(gpu, &targets.depth_stencil_texture);
        self.targets = Some(targets);
        stencil
    }

    /// Pixels on receivers of planar shadows that a light sample reaches or would reach.
    fn receivers(
        &self,
        gpu: &Gpu,
        targets: &LightTargets,
        subject: Subject<'_>,
        lights: &LightUniforms,
        index: usize,
    ) -> Result<Vec<bool>, GpuError> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        direct_light::clear(&mut encoder, targets);
        let mut pass = direct_light::begin(&mut encoder, targets);
        pass.set_bind_group(0, subject.frame, &[]);
        lights.bind(&mut pass, index);
        self.on_receivers.draw(&mut pass, subject.seen, subject.settings);
        drop(pass);
        gpu.queue.submit([encoder.finish()]);
        lit_pixels(gpu, targets)
    }
}

/// Pixels in which at least half of the light sample is seen.
fn lit_pixels(gpu: &Gpu, targets: &LightTargets) -> Result<Vec<bool>, GpuError> {
    if targets.irradiance.format() == wgpu::TextureFormat::Rgba32Float {
        let bytes = read_texture(gpu, &targets.irradiance, 16)?;
        let seen = |pixel: &[u8; 16]| f32::from_le_bytes([pixel[12], pixel[13], pixel[14], pixel[15]]);
        return Ok(bytes.as_chunks().0.iter().map(|pixel| seen(pixel) >= 0.5).collect());
    }
    let bytes = read_texture(gpu, &targets.irradiance, 8)?;
    let seen = |pixel: &[u8; 8]| f32_from_half(u16::from_le_bytes([pixel[6], pixel[7]]));
    Ok(bytes.as_chunks().0.iter().map(|pixel| seen(pixel) >= 0.5).collect())
}
