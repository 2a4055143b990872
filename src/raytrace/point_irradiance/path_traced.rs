//! Reference irradiance at given points by path tracing, with standard errors.
//!
//! Equation: E = mean over the paths of L cos / p, with directions drawn with density p = cos / pi. The standard error
//! of the mean of n independent estimates x_i is sqrt(sum (x_i - mean)^2 / (n (n - 1))).

use std::f32::consts::{FRAC_1_PI, PI};
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::Vec3;
use rayon::prelude::*;

use crate::base::progress::{Progress, Stage};
use crate::base::sampling::{cosine_hemisphere, hash};
use crate::raytrace::path::path_tracer::PathTracer;
use crate::raytrace::path::ray_caster::RayCaster;
use crate::raytrace::point_irradiance::point::{MeasuringPoint, PointOnSurface};
use crate::raytrace::ray::{Ray, RaySource};
use crate::raytrace::sampler::Sampler;
use crate::raytrace::settings::PathSettings;
use crate::trace::Tracer;

/// Number of independent estimates at a point. Their scatter gives the standard error.
const NUM_BATCHES: u32 = 32;

/// Irradiance at a point, lux per channel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Irradiance {
    /// Direct and indirect irradiance.
    pub total: Vec3,
    /// The part that comes straight from lights.
    pub direct: Vec3,
    /// Standard error of `total`.
    pub total_error: Vec3,
    /// Standard error of `direct`.
    pub direct_error: Vec3,
}

/// Estimates the irradiance at points by [`PathSettings::samples`] paths each. Returns `None` if it was cancelled.
///
/// Light from directions below the surface on which a point lies is not counted.
#[must_use]
pub fn irradiance(
    tracer: &Tracer<'_>,
    points: &[MeasuringPoint],
    settings: &PathSettings,
    progress: &dyn Progress,
) -> Option<Vec<Irradiance>> {
    let paths = PathTracer::new(tracer, settings);
    let num_done = AtomicUsize::new(0);
    points
        .par_iter()
        .enumerate()
        .map(|(number, point)| {
            if progress.is_cancelled() {
                return None;
            }
            let found = at_point(&paths, point, number as u32, settings);
            let num_done = num_done.fetch_add(1, Ordering::Relaxed) + 1;
            progress.report(Stage::Trace, num_done as f32 / points.len() as f32);
            Some(found)
        })
        .collect()
}

fn at_point(paths: &PathTracer<'_>, point: &MeasuringPoint, number: u32, settings: &PathSettings) -> Irradiance {
    let point = PointOnSurface::of(&paths.rays, point);
    let per_batch = settings.samples.div_ceil(NUM_BATCHES);
    let (mut total, mut direct) = (Spread::default(), Spread::default());
    for batch in 0..NUM_BATCHES {
        let seed = hash(settings.seed) ^ hash(number * NUM_BATCHES + batch);
        let (mut direct_sum, mut indirect_sum) = (Vec3::ZERO, Vec3::ZERO);
        for index in 0..per_batch {
            let (direct, indirect) = sample(paths, &point, &mut Sampler::new(seed, index));
            direct_sum += direct;
            indirect_sum += indirect;
        }
        direct.add(direct_sum / per_batch as f32);
        total.add((direct_sum + indirect_sum) / per_batch as f32);
    }
    let punctual = punctual(&paths.rays, &point);
    Irradiance {
        total: punctual + total.mean(),
        direct: punctual + direct.mean(),
        total_error: total.error(),
        direct_error: direct.error(),
    }
}

/// One estimate of the irradiance straight from emissive surfaces, and of the indirect irradiance.
fn sample(paths: &PathTracer<'_>, point: &PointOnSurface, sampler: &mut Sampler) -> (Vec3, Vec3) {
    let (rays, &PointOnSurface { origin, normal, geometric }) = (&paths.rays, point);
    let density = |direction: Vec3| normal.dot(direction).max(0.0) * FRAC_1_PI;
    let mut direct = Vec3::ZERO;
    if rays.lights.has_emitters() {
        direct += rays.emitter_irradiance(origin, normal, geometric, density, sampler);
    }
    let mut indirect = Vec3::ZERO;
    if paths.connects_at(0) {
        indirect += rays.connected_irradiance(origin, normal, geometric, density, sampler);
    }
    let direction = cosine_hemisphere(normal, sampler.square());
    if direction.dot(geometric) <= 0.0 {
        return (direct, indirect);
    }
    let source = RaySource::Diffuse { normal, density: density(direction) };
    let light = paths.arriving(Ray { origin, direction, source }, sampler);
    // The cosine divided by the density is pi.
    (direct + light.emitted * PI, indirect + light.reflected * PI)
}

/// Irradiance from all punctual lights, which needs no random choice.
fn punctual(rays: &RayCaster<'_>, point: &PointOnSurface) -> Vec3 {
    let above = rays.lights.punctual(point.origin).filter(|arrival| arrival.to_light.dot(point.geometric) > 0.0);
    above
        .map(|arrival| {
            let cosine = point.normal.dot(arrival.to_light).max(0.0);
            let passing = if cosine > 0.0 {
                rays.passing(point.origin, arrival.to_light, arrival.distance).share
            } else {
                Vec3::ZERO
            };
            arrival.irradiance * passing * cosine
        })
        .sum()
}

/// Mean of independent estimates and its standard error.
#[derive(Default)]
struct Spread {
    count: f32,
    sum: Vec3,
    sum_of_squares: Vec3,
}

impl Spread {
    fn add(&mut self, value: Vec3) {
        self.count += 1.0;
        self.sum += value;
        self.sum_of_squares += value * value;
    }

    fn mean(&self) -> Vec3 {
        self.sum / self.count
    }

    /// Standard error of the mean.
    fn error(&self) -> Vec3 {
        let variance = (self.sum_of_squares / self.count - self.mean() * self.mean()).max(Vec3::ZERO);
        (variance / (self.count - 1.0)).map(f32::sqrt)
    }
}
