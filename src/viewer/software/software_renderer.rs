//! Pictures on a software driver: one sample per pixel, and during a movement half the size if that is faster.

use wgpu::util::{TextureBlitter, TextureBlitterBuilder};

use crate::gpu::Gpu;
use crate::render::{Metering, PictureRequest, Renderer};
use crate::viewer::picture::texture::{new_texture, view_of};
use crate::viewer::software::sketch_size::SketchSize;

/// Draws pictures with one sample per pixel into textures of one format.
pub struct SoftwareRenderer {
    format: wgpu::TextureFormat,
    renderer: Renderer,
    /// Enlarges half-size sketches.
    blitter: TextureBlitter,
    /// Target of half-size sketches, and its size.
    target: Option<(wgpu::TextureView, [u32; 2])>,
    sketch_size: SketchSize,
}

impl SoftwareRenderer {
    /// Creates a renderer for textures of `format`, with an automatic exposure from `metering`.
    #[must_use]
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat, metering: Metering<'_>) -> Self {
        let renderer = Renderer::with_metering(gpu, format, 1, metering);
        let blitter = TextureBlitterBuilder::new(&gpu.device, format).sample_type(wgpu::FilterMode::Linear).build();
        Self { format, renderer, blitter, target: None, sketch_size: SketchSize::default() }
    }

    /// Returns the renderer with one sample per pixel.
    #[must_use]
    pub fn renderer(&self) -> &Renderer {
        &self.renderer
    }

    /// Records the time of the last picture of a movement, seconds.
    pub fn note_time(&mut self, seconds: f32) {
        self.sketch_size.note(seconds);
    }

    /// Draws a picture at full size.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        request: &PictureRequest<'_>,
    ) {
        self.renderer.draw(gpu, encoder, target, request);
    }

    /// Draws a picture of a movement, at half the width and height if that is faster, and then enlarges it into
    /// `target`.
    pub fn sketch(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        request: &PictureRequest<'_>,
    ) {
        if self.sketch_size.is_full() {
            return self.draw(gpu, encoder, target, request);
        }
        let size = request.size.map(|side| side.div_ceil(2));
        let (small, _) = match self.target.take() {
            Some(last) if last.1 == size => self.target.insert(last),
            _ => self.target.insert((view_of(&new_texture(gpu, size, self.format)), size)),
        };
        self.renderer.draw(gpu, encoder, small, &PictureRequest { size, ..*request });
        self.blitter.copy(&gpu.device, encoder, small, target);
    }
}
