//! Draws pictures into textures, finely or, where the processor draws, quickly.

use std::sync::Arc;

use super::quick::Quick;
use super::sight::{Detail, Sight};
use crate::gpu::{Gpu, Stopwatch};
use crate::render::{RenderSettings, Renderer, ShadowScene};

/// Samples a pixel of a fine picture.
pub const SAMPLES: u32 = 4;

/// Draws pictures into textures of one format.
pub struct Painter {
    fine: Renderer,
    /// Where the processor draws.
    quick: Option<Quick>,
    /// The last picture was one of a movement.
    is_moving: bool,
}

impl Painter {
    /// A painter for textures of `format`.
    #[must_use]
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        let fine = Renderer::new(gpu, format, SAMPLES);
        Self { quick: gpu.is_software().then(|| Quick::new(gpu, format, &fine)), fine, is_moving: false }
    }

    /// The processor draws, and details cost time.
    #[must_use]
    pub fn is_slow(&self) -> bool {
        self.quick.is_some()
    }

    /// The exposure that was metered for the last picture; none where none was metered.
    #[must_use]
    pub fn metered_ev(&self, gpu: &Gpu) -> Option<f32> {
        // A lost device is told by the next frame.
        self.fine.metered_ev(gpu).ok().flatten()
    }

    /// The last picture took so long, seconds.
    pub fn note_time(&mut self, seconds: f32) {
        self.quick.iter_mut().filter(|_| self.is_moving).for_each(|quick| quick.note_time(seconds));
    }

    /// Pictures are exposed as those that another painter has drawn with the same detail.
    pub fn follow_exposure(&mut self, other: &Self) {
        self.fine.follow_exposure(&other.fine);
        if let (Some(quick), Some(other)) = (&mut self.quick, &other.quick) {
            quick.follow_exposure(other);
        }
    }

    /// Times passes from now on.
    pub fn time(&mut self, watch: Option<&Arc<Stopwatch>>) {
        self.renderers().for_each(|renderer| renderer.time(watch.cloned()));
    }

    /// Draws a sight with settings of its own.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        sight: &Sight,
        settings: &RenderSettings,
        detail: Detail,
    ) {
        let shadows: &Arc<ShadowScene> = &sight.shadows;
        self.renderers().for_each(|renderer| renderer.cast_shadows(Some(Arc::clone(shadows))));
        let (scene, view, size) = (&sight.scene, &sight.view, sight.size);
        let was_moving = std::mem::replace(&mut self.is_moving, detail == Detail::Sketch);
        if let Some(quick) = &mut self.quick {
            // A picture that stands alone has its own exposure; those of a movement follow each other.
            quick.renderer().show_last_exposure(was_moving && self.is_moving);
        }
        match (&mut self.quick, detail) {
            (Some(quick), Detail::Sketch) => quick.sketch(gpu, encoder, target, sight, settings),
            (Some(quick), Detail::Plain) => quick.draw(gpu, encoder, target, sight, settings),
            _ => self.fine.draw(gpu, encoder, target, size, scene, view, settings),
        }
    }

    /// Adds part of the direct light of the next fine picture.
    pub fn add_light(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        sight: &Sight,
        settings: &RenderSettings,
    ) {
        self.fine.cast_shadows(Some(Arc::clone(&sight.shadows)));
        self.fine.add_light(gpu, encoder, sight.size, &sight.scene, &sight.view, settings);
    }

    fn renderers(&mut self) -> impl Iterator<Item = &mut Renderer> {
        std::iter::once(&mut self.fine).chain(self.quick.iter_mut().map(Quick::renderer))
    }
}

/// A texture for a picture.
pub fn texture(gpu: &Gpu, size: [u32; 2], format: wgpu::TextureFormat) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("picture"),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC
            | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

/// The whole of a texture.
pub fn view_of(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
