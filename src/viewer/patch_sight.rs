//! View from here: what a patch sees, and how much each element of the scene counts in it.

use glam::Vec3;

use super::solved::Solved;
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

/// Width of the hemicube, pixels.
const SIZE_PX: u32 = 128;
/// Rays that find the form factors.
const NUM_RAYS: u32 = 1 << 17;

/// What a patch sees.
pub struct PatchSight {
    /// Where it is and which way it faces.
    pub point: MeasuringPoint,
    /// Pixels across and down of the unfolded hemicube.
    pub size: [u32; 2],
    /// It, as displayed: RGBA bytes.
    pub shaded: Vec<u8>,
    /// It, with a colour for each element: RGBA bytes.
    pub items: Vec<u8>,
    /// Form factors `[e]`; 0 for what is not seen.
    pub factors: Vec<f32>,
    /// Share of the view that leaves the scene or ends on backs.
    pub open_share: f32,
}

impl PatchSight {
    /// Looks from a point; none where it was cancelled.
    ///
    /// # Errors
    /// The device failed.
    pub fn from(
        gpu: &Gpu,
        solved: &Solved,
        point: MeasuringPoint,
        settings: &RenderSettings,
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
            shaded: tone_map_on_cpu(view.size, view.radiance, settings).display,
            factors: factors(&row, solved.mesh.elements.len()),
            open_share: row.sky + row.back(),
        }))
    }
}

/// The row with a place for every element.
fn factors(row: &Row, num_elements: usize) -> Vec<f32> {
    let mut factors = vec![0.0; num_elements];
    for entry in &row.entries {
        factors[entry.element.index()] += entry.factor;
    }
    factors
}

/// Share of the view per area of each element `[e]` over the largest such share, 0..1: how strongly an element of this
/// brightness would count.
#[must_use]
pub fn heat(solved: &Solved, factors: &[f32]) -> Vec<f32> {
    let elements = solved.mesh.elements.iter().zip(factors);
    let density: Vec<f32> = elements.map(|(element, factor)| factor / element.area.max(1e-9)).collect();
    let largest = density.iter().copied().fold(f32::MIN_POSITIVE, f32::max);
    density.iter().map(|density| density / largest).collect()
}

/// A colour that tells an element from its neighbours.
fn item_colour(element: u32) -> [u8; 4] {
    let channel = |i: u32| (255.0 * (0.15 + 0.8 * unit_float(hash(hash(element) ^ i)))) as u8;
    [channel(0), channel(1), channel(2), 255]
}

/// Where the patch is and its normal, for a table or a command line.
#[must_use]
pub fn flag(point: &MeasuringPoint) -> String {
    let MeasuringPoint { position: Vec3 { x, y, z }, normal } = point;
    format!("--hemicube-at={x:.4},{y:.4},{z:.4},{:.4},{:.4},{:.4}", normal.x, normal.y, normal.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::ids::ElementId;
    use crate::form_factor::Entry;

    #[test]
    fn entries_of_one_element_add_up() {
        let entry = |element, factor| Entry { element: ElementId::new(element), factor };
        let row = Row { entries: vec![entry(2, 0.25), entry(0, 0.5), entry(2, 0.125)], sky: 0.125, ..Row::default() };
        assert_eq!(factors(&row, 4), [0.5, 0.0, 0.375, 0.0]);
    }
}
