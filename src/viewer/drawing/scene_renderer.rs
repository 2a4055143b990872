//! Draws a picture of the scene at the wanted level of detail.

use std::sync::Arc;

use crate::gpu::{Gpu, Stopwatch};
use crate::render::{Renderer, ShadowScene};
use crate::viewer::picture::content::{Detail, PictureContent};
use crate::viewer::software::software_renderer::SoftwareRenderer;

/// Samples a pixel of a fine picture.
pub const SAMPLES: u32 = 4;

/// Draws pictures into textures of one format.
pub struct SceneRenderer {
    fine: Renderer,
    /// Renderer of the coarse levels of detail on a software driver; `None` on hardware.
    software: Option<SoftwareRenderer>,
    /// The last picture was a sketch.
    is_moving: bool,
}

impl SceneRenderer {
    /// A renderer for textures of `format`.
    #[must_use]
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        let fine = Renderer::new(gpu, format, SAMPLES);
        Self {
            software: gpu.tier.is_software().then(|| SoftwareRenderer::new(gpu, format, &fine)),
            fine,
            is_moving: false,
        }
    }

    /// The driver draws on the CPU, so that coarser levels of detail are faster.
    #[must_use]
    pub fn is_software(&self) -> bool {
        self.software.is_some()
    }

    /// The exposure that was metered for the last picture, stops; `None` if its exposure was fixed or the device is lost.
    #[must_use]
    pub fn metered_ev(&self, gpu: &Gpu) -> Option<f32> {
        // The next frame reports a lost device.
        self.fine.metered_ev(gpu).ok().flatten()
    }

    /// Notes the time of the last picture, seconds: it decides the size of sketches.
    pub fn note_time(&mut self, seconds: f32) {
        self.software.iter_mut().filter(|_| self.is_moving).for_each(|software| software.note_time(seconds));
    }

    /// From now on takes the exposure of the pictures that `other` draws at the same level of detail.
    pub fn follow_exposure(&mut self, other: &Self) {
        self.fine.follow_exposure(&other.fine);
        if let (Some(software), Some(other)) = (&mut self.software, &other.software) {
            software.follow_exposure(other);
        }
    }

    /// Times passes with `watch`, or stops timing them.
    pub fn time(&mut self, watch: Option<&Arc<Stopwatch>>) {
        self.renderers().for_each(|renderer| renderer.time(watch.cloned()));
    }

    /// Draws `content` into `target`.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        content: &PictureContent,
        detail: Detail,
    ) {
        let shadows: &Arc<ShadowScene> = &content.shadows;
        self.renderers().for_each(|renderer| renderer.cast_shadows(Some(Arc::clone(shadows))));
        let PictureContent { scene, view, settings, size, .. } = content;
        let was_moving = std::mem::replace(&mut self.is_moving, detail == Detail::Sketch);
        if let Some(software) = &mut self.software {
            // Each sketch of a movement is shown at once, with the exposure metered for the one before it.
            software.renderer().show_last_exposure(was_moving && self.is_moving);
        }
        match (&mut self.software, detail) {
            (Some(software), Detail::Sketch) => software.sketch(gpu, encoder, target, content, settings),
            (Some(software), Detail::Plain) => software.draw(gpu, encoder, target, content, settings),
            _ => self.fine.draw(gpu, encoder, target, *size, scene, view, settings),
        }
    }

    /// Adds part of the direct light of the next fine picture; draws nothing.
    pub fn add_light(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, content: &PictureContent) {
        self.fine.cast_shadows(Some(Arc::clone(&content.shadows)));
        self.fine.add_light(gpu, encoder, content.size, &content.scene, &content.view, &content.settings);
    }

    fn renderers(&mut self) -> impl Iterator<Item = &mut Renderer> {
        std::iter::once(&mut self.fine).chain(self.software.iter_mut().map(SoftwareRenderer::renderer))
    }
}
