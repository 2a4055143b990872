//! What debug views look into: the stencil and the map of one light sample.

use super::{RealTimeLight, Subject};
use crate::gpu::Gpu;
use crate::render::shadow::ShadowSettings;
use crate::render::shadow::light_samples::LightSample;
use crate::render::shadow::light_targets::LightTargets;
use crate::render::shadow::light_uniforms::LightUniforms;

impl RealTimeLight {
    /// Layout of the binding that [`RealTimeLight::map`] makes.
    pub fn map_layout(&self) -> &wgpu::BindGroupLayout {
        self.maps.read_layout()
    }

    /// Draws the shadow map of a light sample; the number of its faces, and the map bound.
    pub fn map(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        subject: Subject<'_>,
        settings: &ShadowSettings,
        sample: &LightSample,
    ) -> (u32, wgpu::BindGroup) {
        let map = self.maps.map(gpu, encoder, subject, sample, &settings.maps);
        (map.num_faces, self.maps.bind(gpu, &map))
    }

    /// Counts the shadows of light sample `index`; the stencil. For passes with one sample a pixel.
    pub fn count(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        size: [u32; 2],
        subject: Subject<'_>,
        settings: &ShadowSettings,
        index: usize,
    ) -> wgpu::TextureView {
        let targets = self.mark(gpu, encoder, size, subject, settings, index);
        let stencil = targets.depth_stencil_texture.create_view(&wgpu::TextureViewDescriptor {
            aspect: wgpu::TextureAspect::StencilOnly,
            ..Default::default()
        });
        self.targets = Some(targets);
        stencil
    }

    /// Marks the shadows of light sample `index` in the stencil of the targets.
    pub(super) fn mark(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        size: [u32; 2],
        subject: Subject<'_>,
        settings: &ShadowSettings,
        index: usize,
    ) -> LightTargets {
        let samples = settings.samples(subject.shadows);
        let targets = self.targets_of(gpu, size);
        let lights = LightUniforms::new(gpu, &self.sample_layout, &samples, subject);
        self.prepare(gpu, subject, &samples, settings);
        self.prepass.draw(encoder, &targets, subject.frame, subject.seen, subject.settings);
        self.mark_shadows(gpu, encoder, &targets, subject, settings, &lights, (index, &samples[index]));
        targets
    }
}
