//! Quick pictures, where the processor draws: one sample a pixel, and in a movement half the size if need be.

use wgpu::util::{TextureBlitter, TextureBlitterBuilder};

use super::motion::Motion;
use super::painter::{texture, view_of};
use super::sight::Sight;
use crate::gpu::Gpu;
use crate::render::{Look, Renderer};

/// Draws quick pictures into textures of one format.
pub struct Quick {
    format: wgpu::TextureFormat,
    full: Renderer,
    /// Of half the size, with targets of its own.
    half: Renderer,
    /// Enlarges sketches.
    blitter: TextureBlitter,
    /// The last small sketch's target and its size.
    target: Option<(wgpu::TextureView, [u32; 2])>,
    motion: Motion,
}

impl Quick {
    /// For textures of `format`; the exposure is that of the last picture of these and of `fine`.
    #[must_use]
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat, fine: &Renderer) -> Self {
        let renderer = || {
            let mut renderer = Renderer::new(gpu, format, 1);
            renderer.share_meter(fine);
            renderer
        };
        let blitter = TextureBlitterBuilder::new(&gpu.device, format).sample_type(wgpu::FilterMode::Linear).build();
        Self { format, full: renderer(), half: renderer(), blitter, target: None, motion: Motion::default() }
    }

    /// All renderers.
    pub fn renderers(&mut self) -> impl Iterator<Item = &mut Renderer> {
        [&mut self.full, &mut self.half].into_iter()
    }

    /// Pictures are exposed as those that another has drawn.
    pub fn follow_exposure(&mut self, other: &Self) {
        self.renderers().for_each(|renderer| renderer.follow_exposure(&other.full));
    }

    /// As [`Renderer::show_last_exposure`].
    pub fn show_last_exposure(&mut self, shows: bool) {
        self.renderers().for_each(|renderer| renderer.show_last_exposure(shows));
    }

    /// The last picture of a movement took so long, seconds.
    pub fn note_time(&mut self, seconds: f32) {
        self.motion.note(seconds);
    }

    /// Draws one sample a pixel.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        sight: &Sight,
        look: &Look,
    ) {
        self.full.draw(gpu, encoder, target, sight.size, &sight.scene, &sight.view, look);
    }

    /// Draws as large as there is time for; what is half as wide and high is enlarged into `target`.
    pub fn sketch(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        sight: &Sight,
        look: &Look,
    ) {
        if self.motion.is_full() {
            return self.draw(gpu, encoder, target, sight, look);
        }
        let size = sight.size.map(|side| side.div_ceil(2));
        let (small, _) = match self.target.take() {
            Some(last) if last.1 == size => self.target.insert(last),
            _ => self.target.insert((view_of(&texture(gpu, size, self.format)), size)),
        };
        self.half.draw(gpu, encoder, small, size, &sight.scene, &sight.view, look);
        self.blitter.copy(&gpu.device, encoder, small, target);
    }
}
