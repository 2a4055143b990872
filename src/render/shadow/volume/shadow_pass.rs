//! The shadow volume techniques: mark the volumes of each light sample in the stencil, then add its light outside them.

use glam::Vec4;

use super::hull::Counting;
use super::shadow_volume::ShadowVolumePass;
use crate::gpu::Gpu;
use crate::render::shadow::light::direct_light::{self, DIRECT_LIGHT, DirectLightPass, LIGHT_UNSHADOWED};
use crate::render::shadow::light::pass_setup::PassSetup;
use crate::render::shadow::light::sample::LightSample;
use crate::render::shadow::light::sample_context::SampleContext;
use crate::render::shadow::light::shadow_pass::ShadowPass;
use crate::render::shadow::light::targets::LightTargets;
use crate::render::shadow::settings::ShadowSettings;
use crate::render::shadow::shared::frame_context::FrameContext;

/// The technique of shadow volumes, counted by depth-pass or depth-fail.
pub struct VolumeShadows {
    volumes: ShadowVolumePass,
    light: DirectLightPass,
}

impl VolumeShadows {
    /// Creates the passes.
    pub fn new(gpu: &Gpu, setup: &PassSetup, counting: Counting) -> Self {
        let light = DirectLightPass::new(gpu, &setup.groups(), (&DIRECT_LIGHT, &[]), setup.samples, &LIGHT_UNSHADOWED);
        Self { volumes: ShadowVolumePass::new(gpu, setup, counting), light }
    }
}

impl ShadowPass for VolumeShadows {
    fn prepare(&mut self, frame: FrameContext<'_>, settings: &ShadowSettings, samples: &[LightSample]) {
        let lights: Vec<Vec4> = samples.iter().map(LightSample::position).collect();
        self.volumes.prepare(frame, &lights, &settings.volumes);
    }

    fn mark_shadows(&self, pass: &mut wgpu::RenderPass<'_>, sample: SampleContext<'_>) {
        self.volumes.draw(pass, sample.frame, sample.sample.position(), &sample.settings.volumes);
    }

    /// True, because the volume of a triangle lacks the holes in its texture.
    fn needs_cutouts(&self) -> bool {
        true
    }

    fn add_light(&mut self, encoder: &mut wgpu::CommandEncoder, targets: &LightTargets, sample: SampleContext<'_>) {
        self.light.draw(&mut direct_light::begin(encoder, targets, sample), sample.frame);
    }

    fn clear_scene(&mut self) {
        self.volumes.clear_scene();
    }
}
