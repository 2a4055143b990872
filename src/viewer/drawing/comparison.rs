//! The heat map of the pixels in which two shadow techniques disagree.

use crate::base::colour::srgb_from_linear;
use crate::gpu::Gpu;
use crate::render::ShadowSettings;
use crate::render::shadow::{ComparedScene, ShadowComparison};
use crate::viewer::picture::content::{Detail, PictureContent};
use crate::viewer::picture::texture::write;

/// Draws heat maps of the difference between two shadow techniques.
pub struct DifferenceHeatMap {
    comparison: ShadowComparison,
}

impl DifferenceHeatMap {
    /// Creates the passes, which can draw any scene.
    #[must_use]
    pub fn new(gpu: &Gpu) -> Self {
        Self { comparison: ShadowComparison::new(gpu) }
    }

    /// Fills `texture` with the heat map between the shadows of `content` and `compared`, at half the size for a
    /// sketch.
    ///
    /// Returns the share of pixels that differ; `None` if the device is lost or `content` has no shadows.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        texture: &wgpu::Texture,
        content: &PictureContent,
        compared: &ShadowSettings,
        detail: Detail,
    ) -> Option<f32> {
        let shadows = content.settings.shadows.as_ref()?;
        let step = if detail == Detail::Sketch { 2 } else { 1 };
        let size = content.size.map(|side| side.div_ceil(step));
        let scene = ComparedScene { scene: &content.scene, shadows: &content.shadows, view: &content.view, size };
        let (difference, reference) = self.comparison.compare(gpu, scene, shadows, compared).ok()?;
        let colours = difference.picture(&reference);
        let pixel = |x: u32, y: u32| {
            let colour = colours[(y / step * size[0] + x / step) as usize];
            let [r, g, b] = colour.to_array().map(|channel| (255.0 * srgb_from_linear(channel)).round() as u8);
            [r, g, b, 255]
        };
        let pixels = (0..content.size[1]).flat_map(|y| (0..content.size[0]).map(move |x| (x, y)));
        let display: Vec<u8> = pixels.flat_map(|(x, y)| pixel(x, y)).collect();
        write(gpu, texture, &display);
        Some(difference.share)
    }
}
