//! The shadow map technique: draws the map of each light sample, then adds its light where the map has no caster in
//! front of the point.

use super::pcf::{MapKind, PcfPasses};
use super::shadow_map::ShadowMapPass;
use crate::gpu::Gpu;
use crate::render::shadow::light::direct_light;
use crate::render::shadow::light::pass_setup::PassSetup;
use crate::render::shadow::light::sample_context::SampleContext;
use crate::render::shadow::light::shadow_pass::ShadowPass;
use crate::render::shadow::light::targets::LightTargets;

/// Shadow maps.
pub struct MapShadows {
    maps: ShadowMapPass,
    light: PcfPasses,
}

impl MapShadows {
    /// Creates the passes.
    pub fn new(gpu: &Gpu, setup: &PassSetup) -> Self {
        let maps = ShadowMapPass::new(gpu);
        Self { light: PcfPasses::new(setup, maps.read_layout()), maps }
    }
}

impl ShadowPass for MapShadows {
    fn add_light(&mut self, encoder: &mut wgpu::CommandEncoder, targets: &LightTargets, sample: SampleContext<'_>) {
        let (frame, settings) = (sample.frame, &sample.settings.maps);
        let map = self.maps.map(encoder, frame, sample.sample, settings);
        frame.lap(encoder, "shadow maps");
        let kind = MapKind { is_cube: map.num_faces == 6, pcf_radius: settings.pcf_radius };
        let light = self.light.pass(frame.gpu, kind);
        let mut pass = direct_light::begin(encoder, targets, sample);
        pass.set_bind_group(2, &self.maps.bind(frame.gpu, &map), &[]);
        light.draw(&mut pass, frame);
    }
}
