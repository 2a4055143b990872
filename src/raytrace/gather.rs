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
use crate::base::colour::luminance;
use crate::base::progress::{Progress, Stage};
use crate::base::sampling::cosine_hemisphere;
use crate::trace::Tracer;

/// How closely indirect light is gathered at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GatherPrecision {
    /// Rays that every point takes.
    pub min_rays: u32,
    /// Rays after which a point is left as it is.
    pub max_rays: u32,
    /// Standard error of a point's irradiance, direct part included, that is good enough; relative.
    pub error: f32,
}

/// Independent sets of rays at a point, from whose scatter the standard error follows.
const NUM_STREAMS: u32 = 16;

/// Indirect irradiance at points by a final gather: rays look for surfaces, which reflect the stored indirect light, and
/// direct light found there anew: vertices may be too coarse for its shadows. Rays double until the standard error is
/// small beside the whole irradiance, of which `direct` is known.
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
    direct: &[Vec3],
    precision: &GatherPrecision,
    progress: &dyn Progress,
) -> Option<Vec<Vec3>> {
    let (rays, stored) = (PathTracer::new(tracer, 0, false), StoredLight::new(baked));
    let num_done = AtomicUsize::new(0);
    points
        .par_iter()
        .zip(direct)
        .enumerate()
        .map(|(number, (point, &direct))| {
            if progress.is_cancelled() {
                return None;
            }
            let place = Place::of(&rays, point);
            let seen = |stream: u32, index| {
                let seed = number as u32 * NUM_STREAMS + stream;
                gathered(&rays, &stored, &place, &mut Sampler::new(seed, index))
            };
            let irradiance = refined(seen, direct, precision);
            let num_done = num_done.fetch_add(1, Ordering::Relaxed) + 1;
            progress.report(Stage::Trace, num_done as f32 / points.len() as f32);
            Some(irradiance)
        })
        .collect()
}

/// Mean of `seen` over its streams, with ever more rays until it is known well enough.
fn refined(seen: impl Fn(u32, u32) -> Vec3, direct: Vec3, precision: &GatherPrecision) -> Vec3 {
    let mut sums = [Vec3::ZERO; NUM_STREAMS as usize];
    let mut done = 0;
    let mut length = precision.min_rays.div_ceil(NUM_STREAMS);
    loop {
        for (stream, sum) in (0..).zip(&mut sums) {
            *sum += (done..length).map(|index| seen(stream, index)).sum::<Vec3>();
        }
        let means = sums.map(|sum| luminance(sum) / length as f32);
        let mean = means.iter().sum::<f32>() / NUM_STREAMS as f32;
        let scatter = means.iter().map(|value| (value - mean).powi(2)).sum::<f32>();
        let error = (scatter / (NUM_STREAMS * (NUM_STREAMS - 1)) as f32).sqrt();
        if error <= precision.error * (mean + luminance(direct)) || length * NUM_STREAMS >= precision.max_rays {
            return sums.iter().sum::<Vec3>() / (length * NUM_STREAMS) as f32;
        }
        done = length;
        length = (2 * length).min(precision.max_rays.div_ceil(NUM_STREAMS));
    }
}

/// Bounces after which stored light is taken as it is.
const MAX_BOUNCES: u32 = 8;

/// Edges of an element from which on its stored light is trusted.
const TRUSTED_FROM: f32 = 4.0;

/// What one direction of the hemisphere brings, times pi.
///
/// Stored light is as coarse as the elements: a ray not much longer than the element that it meets could tell nothing else
/// than the place itself. Such rays go on, until one is long enough (Christensen 1999, "Faster photon map global
/// illumination").
fn gathered(rays: &PathTracer<'_>, stored: &StoredLight<'_>, place: &Place, sampler: &mut Sampler) -> Vec3 {
    let direction = cosine_hemisphere(place.normal, sampler.square());
    if direction.dot(place.geometric) <= 0.0 {
        return Vec3::ZERO;
    }
    let (mut light, mut throughput) = (Vec3::ZERO, Vec3::ONE);
    let mut ray = Ray { origin: place.origin, direction, chance: Chance::Only };
    for bounce in 0.. {
        let Some(hit) = rays.meet(&ray, sampler) else { break };
        let surface = Surface::at(rays.scene(), &ray, &hit, false);
        if surface.reflectance == Vec3::ZERO {
            break;
        }
        light += throughput * (PI * rays.direct(&surface, sampler));
        throughput *= surface.reflectance;
        if bounce == MAX_BOUNCES || hit.distance > TRUSTED_FROM * longest_edge(rays.scene().corners(hit.triangle)) {
            light += throughput * stored.indirect(&surface);
            break;
        }
        let direction = cosine_hemisphere(surface.geometric, sampler.square());
        ray = Ray { origin: rays.above(surface.position, surface.geometric), direction, chance: Chance::Only };
    }
    light
}

fn longest_edge([a, b, c]: [Vec3; 3]) -> f32 {
    a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a)).sqrt()
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
