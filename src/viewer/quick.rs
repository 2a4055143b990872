//! Quick pictures, where the processor draws: one sample a pixel, and in a movement half the size if need be.

use wgpu::util::{TextureBlitter, TextureBlitterBuilder};

use crate::gpu::Gpu;
use crate::render::{RenderSettings, Renderer};
use crate::viewer::motion::Motion;
use crate::viewer::picture::content::PictureContent;
use crate::viewer::picture::texture::{new_texture, view_of};

/// Draws quick pictures into textures of one format.
pub struct Quick {
    format: wgpu::TextureFormat,
    renderer: Renderer,
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
        let mut renderer = Renderer::new(gpu, format, 1);
        renderer.share_meter(fine);
        let blitter = TextureBlitterBuilder::new(&gpu.device, format).sample_type(wgpu::FilterMode::Linear).build();
        Self { format, renderer, blitter, target: None, motion: Motion::default() }
    }

    /// What draws.
    pub fn renderer(&mut self) -> &mut Renderer {
        &mut self.renderer
    }

    /// Pictures are exposed as those that another has drawn.
    pub fn follow_exposure(&mut self, other: &Self) {
        self.renderer.follow_exposure(&other.renderer);
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
        content: &PictureContent,
        render_settings: &RenderSettings,
    ) {
        self.renderer.draw(gpu, encoder, target, content.size, &content.scene, &content.view, render_settings);
    }

    /// Draws as large as there is time for; what is half as wide and high is enlarged into `target`.
    pub fn sketch(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        content: &PictureContent,
        render_settings: &RenderSettings,
    ) {
        if self.motion.is_full() {
            return self.draw(gpu, encoder, target, content, render_settings);
        }
        let size = content.size.map(|side| side.div_ceil(2));
        let (small, _) = match self.target.take() {
            Some(last) if last.1 == size => self.target.insert(last),
            _ => self.target.insert((view_of(&new_texture(gpu, size, self.format)), size)),
        };
        self.renderer.draw(gpu, encoder, small, size, &content.scene, &content.view, render_settings);
        self.blitter.copy(&gpu.device, encoder, small, target);
    }
}
