//! Irradiance at points from a bake: as it is stored, or by a final gather from all directions.

use std::f32::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::Vec3;
use rayon::prelude::*;

use crate::baked::BakedScene;
use crate::base::colour::luminance;
use crate::base::progress::{Progress, Stage};
use crate::base::sampling::cosine_hemisphere;
use crate::raytrace::path::ray_caster::RayCaster;
use crate::raytrace::point_irradiance::point::{MeasuringPoint, PointOnSurface, surface_at};
use crate::raytrace::ray::{Ray, RaySource};
use crate::raytrace::sampler::Sampler;
use crate::raytrace::stored_light::StoredLight;
use crate::raytrace::surface::hit::Surface;
use crate::trace::Tracer;

/// Precision of a final gather at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GatherPrecision {
    /// Smallest number of rays per point.
    pub min_rays: u32,
    /// Largest number of rays per point.
    pub max_rays: u32,
    /// No more rays are cast at a point once the standard error of its irradiance is below this share of the
    /// irradiance, direct part included.
    pub error: f32,
}

/// Number of independent sets of rays at a point. Their scatter gives the standard error.
const NUM_STREAMS: u32 = 16;

/// Computes the indirect irradiance at points by a final gather. Returns `None` if it was cancelled.
///
/// Equation: E = mean over cosine-distributed rays of rho (E_direct + E_indirect) where the ray ends.
///
/// E_indirect is the stored light; E_direct is sampled anew, because the shadows of direct light may be finer than the
/// mesh. The number of rays doubles until the standard error is small relative to the total irradiance. `direct` is
/// the direct part of the irradiance `[point]`. `tracer` must hold the elements of `baked`.
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
    let (rays, stored) = (RayCaster::new(tracer, false), StoredLight::new(baked));
    let num_done = AtomicUsize::new(0);
    points
        .par_iter()
        .zip(direct)
        .enumerate()
        .map(|(number, (point, &direct))| {
            if progress.is_cancelled() {
                return None;
            }
            let point = PointOnSurface::of(&rays, point);
            let seen = |stream: u32, index| {
                let seed = number as u32 * NUM_STREAMS + stream;
                gathered(&rays, &stored, &point, &mut Sampler::new(seed, index))
            };
            let irradiance = refined(seen, direct, precision);
            let num_done = num_done.fetch_add(1, Ordering::Relaxed) + 1;
            progress.report(Stage::Trace, num_done as f32 / points.len() as f32);
            Some(irradiance)
        })
        .collect()
}

/// Returns the mean of `seen(stream, index)`. The number of rays doubles until the standard error is small enough.
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

/// Number of bounces after which the stored light is used, however short the last ray is.
const MAX_BOUNCES: u32 = 8;

/// The stored light of an element is used if the ray that hits it is at least this long, in edges of the element.
const TRUSTED_FROM: f32 = 4.0;

/// Indirect radiance from one random direction of the hemisphere, times pi.
///
/// Stored light is as coarse as the elements: at a distance of about an element it is no better than the light stored
/// at the point itself. After such a short ray, the path continues with another bounce until a ray is long enough.
///
/// Source: Christensen 1999, "Faster photon map global illumination".
fn gathered(rays: &RayCaster<'_>, stored: &StoredLight<'_>, point: &PointOnSurface, sampler: &mut Sampler) -> Vec3 {
    let direction = cosine_hemisphere(point.normal, sampler.square());
    if direction.dot(point.geometric) <= 0.0 {
        return Vec3::ZERO;
    }
    let (mut light, mut throughput) = (Vec3::ZERO, Vec3::ONE);
    let mut ray = Ray { origin: point.origin, direction, source: RaySource::Unshared };
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
        ray = Ray { origin: rays.above(surface.position, surface.geometric), direction, source: RaySource::Unshared };
    }
    light
}

fn longest_edge([a, b, c]: [Vec3; 3]) -> f32 {
    a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a)).sqrt()
}

/// Interpolates the stored direct and indirect irradiance at points. A value is `None` if the point lies on no surface.
///
/// `tracer` must hold the elements of `baked`.
#[must_use]
pub fn stored_irradiance(
    tracer: &Tracer<'_>,
    baked: &BakedScene,
    points: &[MeasuringPoint],
) -> Vec<Option<(Vec3, Vec3)>> {
    let (rays, stored) = (RayCaster::new(tracer, false), StoredLight::new(baked));
    let look_up = |point: &MeasuringPoint| {
        let normal = point.normal.normalize();
        let hit = surface_at(&rays, point)?;
        let ray = Ray { origin: point.position + normal, direction: -normal, source: RaySource::Unshared };
        let surface = Surface::at(rays.scene(), &ray, &hit, false);
        let indirect = stored.indirect(&surface);
        Some((stored.total(&surface) - indirect, indirect))
    };
    points.par_iter().map(look_up).collect()
}
