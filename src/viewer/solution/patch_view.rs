//! The view from a patch: its unfolded hemicube as a picture, and the form factors of all elements.

use glam::Vec3;

use crate::bake::patch_view::patch_view;
use crate::base::progress::Progress;
use crate::base::sampling::{hash, unit_float};
use crate::form_factor::hemisphere::Hemispheres;
use crate::form_factor::{Row, map_rows};
use crate::gpu::Gpu;
use crate::radiosity::Viewpoints;
use crate::raytrace::MeasuringPoint;
use crate::render::{RenderSettings, tone_map_on_cpu};
use crate::trace::Tracer;
use crate::viewer::solution::solved::SolvedScene;

/// Resolution of the hemicube, pixels.
const SIZE_PX: u32 = 128;
/// Number of rays that estimate the form factors.
const NUM_RAYS: u32 = 1 << 17;

/// The view from the patch that the user has chosen.
pub struct ChosenPatchView {
    /// Position and normal of the patch.
    pub point: MeasuringPoint,
    /// Width and height of the unfolded hemicube, pixels.
    pub size: [u32; 2],
    /// The unfolded hemicube as displayed: RGBA bytes.
    pub shaded: Vec<u8>,
    /// The unfolded hemicube with a colour for each element: RGBA bytes.
    pub items: Vec<u8>,
    /// Form factors `[e]` from the patch to each element.
    pub factors: Vec<f32>,
    /// Form factor of the sky and of black backs.
    pub open_share: f32,
}

impl ChosenPatchView {
    /// Computes the view from `point`; `None` if it was cancelled.
    ///
    /// # Errors
    /// Returns an error if the device is lost.
    pub fn compute(
        gpu: &Gpu,
        solved: &SolvedScene,
        point: MeasuringPoint,
        render_settings: &RenderSettings,
        progress: &dyn Progress,
    ) -> anyhow::Result<Option<Self>> {
        let viewpoint = Viewpoints::new(&solved.scene).above(point.position, point.normal, 0);
        let tracer = Tracer::new(&solved.scene);
        let mut method = Hemispheres::new(&tracer, &solved.mesh, NUM_RAYS);
        let go_on = || !progress.is_cancelled();
        let Some(row) = map_rows(&mut method, &[viewpoint], &go_on, |_, row| row.clone())?.pop() else {
            return Ok(None);
        };
        let view = patch_view(gpu, &solved.baked, &viewpoint, SIZE_PX)?;
        let item = |item: &Option<u32>| item.map_or([0, 0, 0, 255], item_colour);
        Ok(Some(Self {
            point,
            size: view.size,
            items: view.items.iter().flat_map(item).collect(),
            shaded: tone_map_on_cpu(view.size, view.radiance, render_settings).display,
            factors: factors(&row, solved.mesh.elements.len()),
            open_share: row.sky + row.back(),
        }))
    }
}

/// Expands a sparse row into a dense one.
fn factors(row: &Row, num_elements: usize) -> Vec<f32> {
    let mut factors = vec![0.0; num_elements];
    for entry in &row.entries {
        factors[entry.element.index()] += entry.factor;
    }
    factors
}

/// Computes form factor / area of each element `[e]`, relative to the largest, 0..1. This is the contribution of unit
/// area of the element at unit radiosity.
#[must_use]
pub fn heat(solved: &SolvedScene, factors: &[f32]) -> Vec<f32> {
    let elements = solved.mesh.elements.iter().zip(factors);
    let density: Vec<f32> = elements.map(|(element, factor)| factor / element.area.max(1e-9)).collect();
    let largest = density.iter().copied().fold(f32::MIN_POSITIVE, f32::max);
    density.iter().map(|density| density / largest).collect()
}

/// Returns a random colour for an element, so that neighbours differ.
fn item_colour(element: u32) -> [u8; 4] {
    let channel = |i: u32| (255.0 * (0.15 + 0.8 * unit_float(hash(hash(element) ^ i)))) as u8;
    [channel(0), channel(1), channel(2), 255]
}

/// Formats position and normal of the patch as an option of `hemicube render`.
#[must_use]
pub fn render_option(point: &MeasuringPoint) -> String {
    let MeasuringPoint { position: Vec3 { x, y, z }, normal } = point;
    format!("--hemicube-at={x:.4},{y:.4},{z:.4},{:.4},{:.4},{:.4}", normal.x, normal.y, normal.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::ids::ElementId;
    use crate::form_factor::Entry;

    #[test]
    fn entries_of_the_same_element_are_added() {
        let entry = |element, factor| Entry { element: ElementId::new(element), factor };
        let row = Row { entries: vec![entry(2, 0.25), entry(0, 0.5), entry(2, 0.125)], sky: 0.125, ..Row::default() };
        assert_eq!(factors(&row, 4), [0.5, 0.0, 0.375, 0.0]);
    }
}
