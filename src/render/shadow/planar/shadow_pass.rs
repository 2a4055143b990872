//! The planar shadow technique: marks shadows on receivers, and adds the light of each sample elsewhere.

use super::planar_shadow::PlanarShadowPass;
use crate::gpu::Gpu;
use crate::render::shadow::light::direct_light::{self, DIRECT_LIGHT, DirectLightPass, LIGHT_UNSHADOWED, LightBlend};
use crate::render::shadow::light::pass_setup::PassSetup;
use crate::render::shadow::light::sample::LightSample;
use crate::render::shadow::light::sample_context::SampleContext;
use crate::render::shadow::light::shadow_pass::ShadowPass;
use crate::render::shadow::light::targets::LightTargets;
use crate::render::shadow::settings::ShadowSettings;
use crate::render::shadow::shared::frame_context::FrameContext;
use crate::render::shadow::shared::stencil::{RECEIVER_BITS, SHADOW_BITS};

/// Adds light where no shadow is counted, on receivers and on all other surfaces.
const OUTSIDE_SHADOWS: LightBlend = LightBlend { read_mask: SHADOW_BITS, ..LIGHT_UNSHADOWED };
/// Subtracts light where at least two shadows overlap.
const UNDER_TWO_SHADOWS: LightBlend = LightBlend {
    read_mask: SHADOW_BITS,
    compare: wgpu::CompareFunction::LessEqual,
    reference: 2,
    operation: wgpu::BlendOperation::ReverseSubtract,
};
/// Adds light on all receivers.
const ON_RECEIVERS: LightBlend =
    LightBlend { read_mask: RECEIVER_BITS, compare: wgpu::CompareFunction::NotEqual, ..LIGHT_UNSHADOWED };

/// The planar shadow technique.
pub struct PlanarShadows {
    shadows: PlanarShadowPass,
    light: DirectLightPass,
    /// Subtracts light a second time, to show the fault of darkening twice.
    darkens_twice: DirectLightPass,
    on_receivers: DirectLightPass,
}

impl PlanarShadows {
    /// Creates the passes.
    pub fn new(gpu: &Gpu, setup: &PassSetup) -> Self {
        let light =
            |blend: &LightBlend| DirectLightPass::new(gpu, &setup.groups(), (&DIRECT_LIGHT, &[]), setup.samples, blend);
        Self {
            shadows: PlanarShadowPass::new(gpu, setup),
            light: light(&OUTSIDE_SHADOWS),
            darkens_twice: light(&UNDER_TWO_SHADOWS),
            on_receivers: light(&ON_RECEIVERS),
        }
    }
}

impl ShadowPass for PlanarShadows {
    fn prepare(&mut self, frame: FrameContext<'_>, settings: &ShadowSettings, _samples: &[LightSample]) {
        self.shadows.prepare(frame, &settings.planar);
    }

    fn mark_shadows(&self, pass: &mut wgpu::RenderPass<'_>, sample: SampleContext<'_>) {
        self.shadows.draw(pass, sample.frame, sample.sample.position());
    }

    /// True, because a projected triangle lacks the holes in its texture.
    fn needs_cutouts(&self) -> bool {
        true
    }

    fn add_light(&mut self, encoder: &mut wgpu::CommandEncoder, targets: &LightTargets, sample: SampleContext<'_>) {
        let mut pass = direct_light::begin(encoder, targets, sample);
        self.light.draw(&mut pass, sample.frame);
        if !sample.settings.planar.darkens_once {
            self.darkens_twice.draw(&mut pass, sample.frame);
        }
    }

    fn receivers(&self) -> Option<&DirectLightPass> {
        Some(&self.on_receivers)
    }
}
