//! How far two shadow techniques differ: in how many pixels they decide differently whether a light is seen.
//!
//! Edges of shadows move by less than a pixel between techniques, and that is no fault: decisions count only more than
//! one pixel away from an edge of the reference's shadow.

use glam::Vec3;

use super::real_time::{RealTimeLight, SampleDecisions, Subject};
use super::{ShadowScene, ShadowSettings};
use crate::gpu::{Gpu, GpuError};
use crate::render::frame_uniform::{frame_bind_group, frame_layout};
use crate::render::scene::SceneBuffers;
use crate::render::{RenderSettings, View};

/// Which pixels the lights of a scene reach.
#[derive(Clone, Debug, PartialEq)]
pub struct Decisions {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Of each light sample.
    pub samples: Vec<SampleDecisions>,
}

/// How far one technique is from another.
#[derive(Clone, Debug, PartialEq)]
pub struct ShadowDifference {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Share of all pixels in which the decision about at least one light sample differs.
    pub share: f32,
    /// Number of light samples about which the techniques differ, pixel by pixel.
    pub count: Vec<u32>,
    /// Lit here and dark in the reference, `[pixel]`; only meaningful where `count` is not zero.
    pub is_too_bright: Vec<bool>,
}

/// Asks techniques what they decide; its passes are made once.
pub struct Judge {
    layout: wgpu::BindGroupLayout,
    light: RealTimeLight,
}

/// What is judged: a scene on the device, its shadows, and from where they are seen in how many pixels.
#[derive(Clone, Copy)]
pub struct Case<'a> {
    /// On the device.
    pub scene: &'a SceneBuffers,
    /// Its casters and lights.
    pub shadows: &'a ShadowScene,
    /// From where.
    pub view: &'a View,
    /// Pixels across and down.
    pub size: [u32; 2],
}

impl Judge {
    /// Passes with one sample a pixel.
    #[must_use]
    pub fn new(gpu: &Gpu) -> Self {
        let layout = frame_layout(gpu);
        Self { light: RealTimeLight::new(gpu, &layout, 1), layout }
    }

    /// Decisions of a technique about all light samples.
    ///
    /// # Errors
    /// The device was lost.
    pub fn decisions(&mut self, gpu: &Gpu, case: Case<'_>, settings: &ShadowSettings) -> Result<Decisions, GpuError> {
        let samples = self.ask(gpu, case, |light, subject| light.decisions(gpu, case.size, subject, settings))?;
        Ok(Decisions { size: case.size, samples })
    }

    /// What the stencil holds after the shadows of light sample `index`, a byte a pixel.
    ///
    /// # Errors
    /// The device was lost.
    pub fn stencil(
        &mut self,
        gpu: &Gpu,
        case: Case<'_>,
        settings: &ShadowSettings,
        index: usize,
    ) -> Result<Vec<u8>, GpuError> {
        self.ask(gpu, case, |light, subject| light.stencil(gpu, case.size, subject, settings, index))
    }

    fn ask<T>(&mut self, gpu: &Gpu, case: Case<'_>, of: impl FnOnce(&mut RealTimeLight, Subject<'_>) -> T) -> T {
        let render_settings = RenderSettings::default();
        let frame = frame_bind_group(gpu, &self.layout, case.scene, case.view, &render_settings);
        let Case { scene, shadows, view, .. } = case;
        // The last case may have been another scene.
        self.light.forget();
        let seen = &scene.in_view(gpu, &view.cull_view(&render_settings));
        of(
            &mut self.light,
            Subject { frame: &frame, scene, seen, shadows, view, settings: &render_settings, watch: None },
        )
    }
}

impl Decisions {
    /// Pixels next to one with the other decision about a light sample.
    fn edges(&self, lit: &[bool]) -> Vec<bool> {
        let [width, height] = self.size.map(|side| side as usize);
        let is_edge = |at: usize| {
            let (x, y) = (at % width, at / width);
            let columns = x.saturating_sub(1)..=(x + 1).min(width - 1);
            let mut rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
            rows.any(|row| columns.clone().any(|column| lit[row * width + column] != lit[at]))
        };
        (0..lit.len()).map(is_edge).collect()
    }
}

impl SampleDecisions {
    fn claims(&self, pixel: usize) -> bool {
        self.claimed.as_ref().is_none_or(|claimed| claimed[pixel])
    }
}

/// How far `decisions` are from `reference`.
#[must_use]
pub fn shadow_difference(decisions: &Decisions, reference: &Decisions) -> ShadowDifference {
    let num_pixels = (reference.size[0] * reference.size[1]) as usize;
    let (mut count, mut is_too_bright) = (vec![0; num_pixels], vec![false; num_pixels]);
    for (ours, theirs) in decisions.samples.iter().zip(&reference.samples) {
        let edges = reference.edges(&theirs.lit);
        let differs =
            |&pixel: &usize| ours.lit[pixel] != theirs.lit[pixel] && ours.claims(pixel) && theirs.claims(pixel);
        for pixel in (0..num_pixels).filter(differs).filter(|&pixel| !edges[pixel]) {
            count[pixel] += 1;
            is_too_bright[pixel] = ours.lit[pixel];
        }
    }
    let share = count.iter().filter(|&&count| count > 0).count() as f32 / num_pixels.max(1) as f32;
    ShadowDifference { size: reference.size, share, count, is_too_bright }
}

impl ShadowDifference {
    /// A picture of the difference over the shadows of the reference: grey by the share of lights seen, red where too
    /// much light is seen, blue where too little.
    #[must_use]
    pub fn picture(&self, reference: &Decisions) -> Vec<Vec3> {
        let num_samples = reference.samples.len().max(1) as f32;
        let colour = |pixel: usize| match (self.count[pixel] > 0, self.is_too_bright[pixel]) {
            (true, true) => Vec3::new(1.0, 0.1, 0.0),
            (true, false) => Vec3::new(0.0, 0.3, 1.0),
            (false, _) => {
                let seen = reference.samples.iter().filter(|sample| sample.lit[pixel]).count() as f32;
                Vec3::splat(0.02 + 0.4 * seen / num_samples)
            }
        };
        (0..self.count.len()).map(colour).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One light over 8 x 8 pixels.
    fn decisions(lit: impl Fn(usize, usize) -> bool) -> Decisions {
        let lit = (0..64).map(|i| lit(i % 8, i / 8)).collect();
        Decisions { size: [8, 8], samples: vec![SampleDecisions { lit, claimed: None }] }
    }

    #[test]
    fn an_edge_may_move_by_a_pixel_and_no_further() {
        let edge_at = |edge: usize| decisions(move |x, _| x < edge);
        let share = |a, b| shadow_difference(&edge_at(a), &edge_at(b)).share;
        assert_eq!(share(4, 4), 0.0);
        assert_eq!(share(5, 4), 0.0);
        assert_eq!(share(6, 4), 1.0 / 8.0);
    }

    #[test]
    fn a_single_wrong_pixel_counts() {
        let all = decisions(|_, _| true);
        let hole = decisions(|x, y| (x, y) != (3, 5));
        let difference = shadow_difference(&hole, &all);
        assert_eq!(difference.share, 1.0 / 64.0);
        assert!(!difference.is_too_bright[5 * 8 + 3]);
    }
}
