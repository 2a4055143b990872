//! Reference irradiance at given points, with standard errors.

use std::f32::consts::{FRAC_1_PI, PI};
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::Vec3;
use rayon::prelude::*;

use super::path::{Chance, PathTracer, Ray};
use super::sampler::Sampler;
use super::settings::PathSettings;
use crate::base::progress::{Progress, Stage};
use crate::base::sampling::{cosine_hemisphere, hash};
use crate::trace::{Hit, Tracer};

/// Independent estimates at a point, from whose scatter the standard error follows.
const NUM_BATCHES: u32 = 32;

/// Distance within which a point's surface is looked for, as a share of the scene's extent.
const REACH: f32 = 1e-4;

/// A point where irradiance is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuringPoint {
    /// On a surface, or anywhere in the open; metres.
    pub position: Vec3,
    /// Unit normal that the light's cosine is taken to.
    pub normal: Vec3,
}

/// Irradiance at a point, lux per channel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Irradiance {
    /// All of it.
    pub total: Vec3,
    /// The part that comes straight from lights.
    pub direct: Vec3,
    /// Standard error of `total`.
    pub total_error: Vec3,
    /// Standard error of `direct`.
    pub direct_error: Vec3,
}

/// Irradiance at points, estimated by [`PathSettings::samples`] paths each. None where it was cancelled.
///
/// Directions below the surface that a point lies on count as dark.
#[must_use]
pub fn irradiance(
    tracer: &Tracer<'_>,
    points: &[MeasuringPoint],
    settings: &PathSettings,
    progress: &dyn Progress,
) -> Option<Vec<Irradiance>> {
    let paths = PathTracer::new(tracer, settings.max_bounces, settings.has_specular);
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
    let place = Place::of(paths, point);
    let per_batch = settings.samples.div_ceil(NUM_BATCHES);
    let (mut total, mut direct) = (Spread::default(), Spread::default());
    for batch in 0..NUM_BATCHES {
        let seed = hash(settings.seed) ^ hash(number * NUM_BATCHES + batch);
        let (mut direct_sum, mut indirect_sum) = (Vec3::ZERO, Vec3::ZERO);
        for index in 0..per_batch {
            let (direct, indirect) = place.sample(paths, &mut Sampler::new(seed, index));
            direct_sum += direct;
            indirect_sum += indirect;
        }
        direct.add(direct_sum / per_batch as f32);
        total.add((direct_sum + indirect_sum) / per_batch as f32);
    }
    let punctual = place.punctual(paths);
    Irradiance {
        total: punctual + total.mean(),
        direct: punctual + direct.mean(),
        total_error: total.error(),
        direct_error: direct.error(),
    }
}

/// A point just above its surface.
pub(super) struct Place {
    pub origin: Vec3,
    /// That of the point.
    pub normal: Vec3,
    /// That of the surface, on the side of the point's.
    pub geometric: Vec3,
}

impl Place {
    pub(super) fn of(paths: &PathTracer<'_>, point: &MeasuringPoint) -> Self {
        let normal = point.normal.normalize();
        let geometric = Self::surface(paths, point).map_or(normal, |hit| {
            let front = crate::scene::normal_of(paths.scene().corners(hit.triangle));
            if front.dot(normal) < 0.0 { -front } else { front }
        });
        Self { origin: paths.above(point.position, geometric), normal, geometric }
    }

    /// The surface that the point lies on.
    pub(super) fn surface(paths: &PathTracer<'_>, point: &MeasuringPoint) -> Option<Hit> {
        let reach = REACH * paths.scene().bounds().extent();
        let normal = point.normal.normalize();
        paths.tracer.nearest(point.position + normal * reach, -normal, 2.0 * reach)
    }

    /// One estimate of the irradiance straight from emissive surfaces, and of the indirect one.
    fn sample(&self, paths: &PathTracer<'_>, sampler: &mut Sampler) -> (Vec3, Vec3) {
        let density = |direction: Vec3| self.normal.dot(direction).max(0.0) * FRAC_1_PI;
        let mut direct = Vec3::ZERO;
        if paths.lights.has_emitters() {
            direct += paths.emitter_irradiance(self.origin, self.normal, self.geometric, density, sampler);
        }
        let mut indirect = Vec3::ZERO;
        if paths.connects_at(0) {
            indirect += paths.connected_irradiance(self.origin, self.normal, self.geometric, density, sampler);
        }
        let direction = cosine_hemisphere(self.normal, sampler.square());
        if direction.dot(self.geometric) <= 0.0 {
            return (direct, indirect);
        }
        let chance = Chance::Among { normal: self.normal, density: density(direction) };
        let light = paths.arriving(Ray { origin: self.origin, direction, chance }, sampler);
        // The cosine and its density leave a factor of pi.
        (direct + light.emitted * PI, indirect + light.reflected * PI)
    }

    /// Irradiance from punctual lights, without chance.
    fn punctual(&self, paths: &PathTracer<'_>) -> Vec3 {
        let above = paths.lights.punctual(self.origin).filter(|arrival| arrival.to_light.dot(self.geometric) > 0.0);
        above
            .map(|arrival| {
                let cosine = self.normal.dot(arrival.to_light).max(0.0);
                let passing = if cosine > 0.0 {
                    paths.passing(self.origin, arrival.to_light, arrival.distance).share
                } else {
                    Vec3::ZERO
                };
                arrival.irradiance * passing * cosine
            })
            .sum()
    }
}

/// Mean of independent estimates and how well it is known.
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
