//! Irradiance at points from a bake: as it is stored, or gathered once more from all directions.

use std::f32::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::Vec3;
use rayon::prelude::*;

use super::irradiance::{MeasuringPoint, Place};
use super::path::{Chance, PathTracer, Ray};
use super::sampler::Sampler;
use super::stored::StoredLight;
use super::surface::Surface;
use crate::baked::BakedScene;
use crate::base::progress::{Progress, Stage};
use crate::base::sampling::cosine_hemisphere;
use crate::trace::Tracer;

/// Indirect irradiance at points by a final gather: so many rays a point look for surfaces, which reflect the stored
/// indirect light, and direct light found there anew: vertices may be too coarse for its shadows.
/// None where it was cancelled. `tracer` holds the elements of `baked`.
///
/// Equation: E = mean over cosine-distributed rays of rho (E_direct + E_indirect) where the ray ends.
///
/// Source: Lischinski, Tampieri, Greenberg 1993, "Combining hierarchical radiosity and discontinuity meshing".
#[must_use]
pub fn gathered_irradiance(
    tracer: &Tracer<'_>,
    baked: &BakedScene,
    points: &[MeasuringPoint],
    num_rays: u32,
    progress: &dyn Progress,
) -> Option<Vec<Vec3>> {
    let (rays, stored) = (PathTracer::new(tracer, 0, false), StoredLight::new(baked));
    let num_done = AtomicUsize::new(0);
    points
        .par_iter()
        .enumerate()
        .map(|(number, point)| {
            if progress.is_cancelled() {
                return None;
            }
            let place = Place::of(&rays, point);
            let seen = |index| gathered(&rays, &stored, &place, &mut Sampler::new(number as u32, index));
            let irradiance = (0..num_rays).map(seen).sum::<Vec3>() / num_rays as f32;
            let num_done = num_done.fetch_add(1, Ordering::Relaxed) + 1;
            progress.report(Stage::Trace, num_done as f32 / points.len() as f32);
            Some(irradiance)
        })
        .collect()
}

/// What one direction of the hemisphere brings, times pi.
fn gathered(rays: &PathTracer<'_>, stored: &StoredLight<'_>, place: &Place, sampler: &mut Sampler) -> Vec3 {
    let direction = cosine_hemisphere(place.normal, sampler.square());
    if direction.dot(place.geometric) <= 0.0 {
        return Vec3::ZERO;
    }
    let ray = Ray { origin: place.origin, direction, chance: Chance::Only };
    let Some(hit) = rays.meet(&ray, sampler) else { return Vec3::ZERO };
    let surface = Surface::at(rays.scene(), &ray, &hit, false);
    if surface.reflectance == Vec3::ZERO {
        return Vec3::ZERO;
    }
    surface.reflectance * stored.indirect(&surface) + PI * rays.direct(&surface, sampler)
}

/// Direct and indirect irradiance as stored at the vertices round each point; none where a point lies on no surface.
/// `tracer` holds the elements of `baked`.
#[must_use]
pub fn stored_irradiance(
    tracer: &Tracer<'_>,
    baked: &BakedScene,
    points: &[MeasuringPoint],
) -> Vec<Option<(Vec3, Vec3)>> {
    let (rays, stored) = (PathTracer::new(tracer, 0, false), StoredLight::new(baked));
    let look_up = |point: &MeasuringPoint| {
        let normal = point.normal.normalize();
        let hit = Place::surface(&rays, point)?;
        let ray = Ray { origin: point.position + normal, direction: -normal, chance: Chance::Only };
        let surface = Surface::at(rays.scene(), &ray, &hit, false);
        let indirect = stored.indirect(&surface);
        Some((stored.total(&surface) - indirect, indirect))
    };
    points.par_iter().map(look_up).collect()
}
