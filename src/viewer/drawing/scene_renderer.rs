//! Draws pictures of the scene at each level of detail.

use std::sync::Arc;

use crate::gpu::{Gpu, Stopwatch};
use crate::render::{MeteredExposure, Metering, PictureRequest, Renderer};
use crate::viewer::picture::content::{Detail, PictureContent};
use crate::viewer::software::software_renderer::SoftwareRenderer;

/// Samples per pixel of a fine picture.
pub const SAMPLES: u32 = 4;

/// Draws pictures into textures of one format.
pub struct SceneRenderer {
    fine: Renderer,
    /// Renderer of the coarse levels of detail on a software driver; `None` on hardware.
    software: Option<SoftwareRenderer>,
    /// Times the passes; `None` unless the panels show the times.
    stopwatch: Option<Arc<Stopwatch>>,
    /// True if the last picture was a sketch.
    is_moving: bool,
}

impl SceneRenderer {
    /// A renderer for textures of `format`.
    #[must_use]
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        let fine = Renderer::new(gpu, format, SAMPLES);
        let software = gpu.tier.is_software().then(|| SoftwareRenderer::new(gpu, format, Metering::Shared(&fine)));
        Self { fine, software, stopwatch: None, is_moving: false }
    }

    /// Creates a renderer for textures of `format`. Its exposure is that of the pictures that `other` draws at the same
    /// level of detail.
    #[must_use]
    pub fn following(gpu: &Gpu, format: wgpu::TextureFormat, other: &Self) -> Self {
        let follow =
            |other: &SoftwareRenderer| SoftwareRenderer::new(gpu, format, Metering::Followed(other.renderer()));
        Self {
            fine: Renderer::with_metering(gpu, format, SAMPLES, Metering::Followed(&other.fine)),
            software: other.software.as_ref().map(follow),
            stopwatch: None,
            is_moving: false,
        }
    }

    /// Returns true if the driver draws on the CPU. Coarser levels of detail are faster there.
    #[must_use]
    pub fn is_software(&self) -> bool {
        self.software.is_some()
    }

    /// Returns the exposure that was metered for the last picture, stops; `None` if its exposure was fixed or the
    /// device is lost.
    #[must_use]
    pub fn metered_ev(&self, gpu: &Gpu) -> Option<f32> {
        // The next frame reports a lost device.
        self.fine.metered_ev(gpu).ok().flatten()
    }

    /// Records the time of the last picture, seconds, from which the size of sketches is chosen.
    pub fn note_time(&mut self, seconds: f32) {
        self.software.iter_mut().filter(|_| self.is_moving).for_each(|software| software.note_time(seconds));
    }

    /// Times passes with `stopwatch`, or stops timing them.
    pub fn time(&mut self, stopwatch: Option<&Arc<Stopwatch>>) {
        self.stopwatch = stopwatch.cloned();
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
        let was_moving = std::mem::replace(&mut self.is_moving, detail == Detail::Sketch);
        // Each sketch of a movement is shown at once, with the exposure metered for the one before it.
        let exposure = if was_moving && self.is_moving { MeteredExposure::OfLast } else { MeteredExposure::OfThis };
        let stopwatch = self.stopwatch.as_deref();
        let request = PictureRequest { exposure, stopwatch, ..content.request() };
        match (&mut self.software, detail) {
            (Some(software), Detail::Sketch) => software.sketch(gpu, encoder, target, &request),
            (Some(software), Detail::Plain) => software.draw(gpu, encoder, target, &request),
            _ => self.fine.draw(gpu, encoder, target, &request),
        }
    }

    /// Adds part of the direct light of the next fine picture, without drawing the picture.
    pub fn add_light(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, content: &PictureContent) {
        let request = PictureRequest { stopwatch: self.stopwatch.as_deref(), ..content.request() };
        self.fine.add_light(gpu, encoder, &request);
    }
}
