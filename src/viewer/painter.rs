//! Draws looks into textures, finely or, where the processor draws, quickly.

use std::sync::Arc;

use wgpu::util::{TextureBlitter, TextureBlitterBuilder};

use super::canvas::{Detail, Sight};
use crate::gpu::{Gpu, Stopwatch};
use crate::render::{Look, Renderer, ShadowScene};

/// Samples a pixel of a fine picture.
pub const SAMPLES: u32 = 4;

/// Draws looks into textures of one format.
pub struct Painter {
    format: wgpu::TextureFormat,
    fine: Renderer,
    /// Where the processor draws.
    quick: Option<Quick>,
}

struct Quick {
    renderer: Renderer,
    /// Enlarges sketches.
    blitter: TextureBlitter,
    /// The last sketch's target and its size.
    target: Option<(wgpu::TextureView, [u32; 2])>,
}

impl Painter {
    /// A painter for textures of `format`.
    #[must_use]
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        let quick = || Quick {
            renderer: Renderer::new(gpu, format, 1),
            blitter: TextureBlitterBuilder::new(&gpu.device, format).sample_type(wgpu::FilterMode::Linear).build(),
            target: None,
        };
        Self { format, fine: Renderer::new(gpu, format, SAMPLES), quick: gpu.is_software().then(quick) }
    }

    /// The processor draws, and details cost time.
    #[must_use]
    pub fn is_slow(&self) -> bool {
        self.quick.is_some()
    }

    /// The exposure that was metered for the last picture, which had this detail; none where none was metered.
    #[must_use]
    pub fn metered_ev(&self, gpu: &Gpu, detail: Detail) -> Option<f32> {
        let renderer = match (&self.quick, detail) {
            (Some(quick), Detail::Sketch | Detail::Plain) => &quick.renderer,
            _ => &self.fine,
        };
        // A lost device is told by the next frame.
        renderer.metered_ev(gpu).ok().flatten()
    }

    /// Pictures are exposed as those that another painter has drawn with the same detail.
    pub fn follow_exposure(&mut self, other: &Self) {
        self.fine.follow_exposure(&other.fine);
        if let (Some(quick), Some(other)) = (&mut self.quick, &other.quick) {
            quick.renderer.follow_exposure(&other.renderer);
        }
    }

    /// Times passes from now on.
    pub fn time(&mut self, watch: Option<&Arc<Stopwatch>>) {
        self.renderers().for_each(|renderer| renderer.time(watch.cloned()));
    }

    /// Draws a sight with a look of its own.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        sight: &Sight,
        look: &Look,
        detail: Detail,
    ) {
        let shadows: &Arc<ShadowScene> = &sight.shadows;
        self.renderers().for_each(|renderer| renderer.cast_shadows(Some(Arc::clone(shadows))));
        let (scene, view, size) = (&sight.scene, &sight.view, sight.size);
        match (&mut self.quick, detail) {
            (Some(quick), Detail::Sketch) => quick.sketch(gpu, encoder, target, self.format, sight, look),
            (Some(quick), Detail::Plain) => quick.renderer.draw(gpu, encoder, target, size, scene, view, look),
            _ => self.fine.draw(gpu, encoder, target, size, scene, view, look),
        }
    }

    /// Adds part of the direct light of the next fine picture.
    pub fn add_light(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, sight: &Sight, look: &Look) {
        self.fine.cast_shadows(Some(Arc::clone(&sight.shadows)));
        self.fine.add_light(gpu, encoder, sight.size, &sight.scene, &sight.view, look);
    }

    fn renderers(&mut self) -> impl Iterator<Item = &mut Renderer> {
        [Some(&mut self.fine), self.quick.as_mut().map(|quick| &mut quick.renderer)].into_iter().flatten()
    }
}

impl Quick {
    /// Draws half as wide and high, and enlarges into `target`.
    fn sketch(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        format: wgpu::TextureFormat,
        sight: &Sight,
        look: &Look,
    ) {
        let size = sight.size.map(|side| side.div_ceil(2));
        let (small, _) = match self.target.take() {
            Some(last) if last.1 == size => self.target.insert(last),
            _ => self.target.insert((view_of(&texture(gpu, size, format)), size)),
        };
        self.renderer.draw(gpu, encoder, small, size, &sight.scene, &sight.view, look);
        self.blitter.copy(&gpu.device, encoder, small, target);
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
