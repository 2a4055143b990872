//! The heat map of where two shadow techniques decide differently.

use super::canvas;
use super::sight::{Detail, Sight};
use crate::base::colour::srgb_from_linear;
use crate::gpu::Gpu;
use crate::render::shadow::{Case, Judge, shadow_difference};
use crate::render::{ShadowSettings, ShadowTechnique};

/// Compares shadows pixel by pixel.
pub struct Differ {
    judge: Judge,
}

impl Differ {
    /// Passes for any scene.
    #[must_use]
    pub fn new(gpu: &Gpu) -> Self {
        Self { judge: Judge::new(gpu) }
    }

    /// Fills `texture` with the heat map between the shadows of `sight` and those of `rival`, at half the size for a sketch; the
    /// share of pixels that differ, none where the device was lost or the sight has no shadows.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        texture: &wgpu::Texture,
        sight: &Sight,
        rival: &ShadowSettings,
        detail: Detail,
    ) -> Option<f32> {
        let shadows = sight.settings.shadows.as_ref()?;
        let step = if detail == Detail::Sketch { 2 } else { 1 };
        let size = sight.size.map(|side| side.div_ceil(step));
        let case = Case { scene: &sight.scene, shadows: &sight.shadows, view: &sight.view, size };
        let ours = self.judge.decisions(gpu, case, shadows).ok()?;
        let theirs = self.judge.decisions(gpu, case, rival).ok()?;
        // The edges that may move are those of the truth, where it is one of the two.
        let is_truth = shadows.technique == ShadowTechnique::Raytraced;
        let (compared, reference) = if is_truth { (&theirs, &ours) } else { (&ours, &theirs) };
        let difference = shadow_difference(compared, reference);
        let colours = difference.picture(reference);
        let pixel = |x: u32, y: u32| {
            let colour = colours[(y / step * size[0] + x / step) as usize];
            let [r, g, b] = colour.to_array().map(|channel| (255.0 * srgb_from_linear(channel)).round() as u8);
            [r, g, b, 255]
        };
        let pixels = (0..sight.size[1]).flat_map(|y| (0..sight.size[0]).map(move |x| (x, y)));
        let display: Vec<u8> = pixels.flat_map(|(x, y)| pixel(x, y)).collect();
        canvas::write(gpu, texture, &display);
        Some(difference.share)
    }
}
