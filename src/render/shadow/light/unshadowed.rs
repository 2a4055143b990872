//! Direct light without shadows.

use super::direct_light::{self, DIRECT_LIGHT, DirectLightPass, LIGHT_UNSHADOWED};
use super::pass_setup::PassSetup;
use super::sample_context::SampleContext;
use super::shadow_pass::ShadowPass;
use super::targets::LightTargets;
use crate::gpu::Gpu;

/// Adds light without shadows: it passes through everything.
pub struct UnshadowedLight {
    light: DirectLightPass,
}

impl UnshadowedLight {
    /// Creates the pass.
    pub fn new(gpu: &Gpu, setup: &PassSetup) -> Self {
        let light = DirectLightPass::new(gpu, &setup.groups(), (&DIRECT_LIGHT, &[]), setup.samples, &LIGHT_UNSHADOWED);
        Self { light }
    }
}

impl ShadowPass for UnshadowedLight {
    fn add_light(&mut self, encoder: &mut wgpu::CommandEncoder, targets: &LightTargets, sample: SampleContext<'_>) {
        self.light.draw(&mut direct_light::begin(encoder, targets, sample), sample.frame);
    }
}
