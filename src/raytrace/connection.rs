//! Light that a point or spot light throws on surfaces close to it, found from the light.
//!
//! A light beside a ceiling makes a small, very bright spot there. Paths from elsewhere meet it seldom: their estimates have
//! a long tail, and the error that they state is too small as long as none has met it. So every diffuse surface is also
//! connected with a place that a ray from a light finds; what either way could find is shared by the power heuristic.
//!
//! Source: Veach 1997, chapter 10 (bidirectional path tracing; here the paths with two vertices from the light).

use std::f32::consts::TAU;

use glam::Vec3;

use super::path::{Chance, PathTracer, Ray, power_heuristic};
use super::sampler::Sampler;
use super::surface::Surface;
use crate::base::colour::luminance;
use crate::base::sampling::tangent_frame;
use crate::scene::{Arrival, LightKind, Scene, edge_cross};
use crate::trace::Hit;

/// Where rays start that look for what lights stand close to.
pub(super) struct Beams {
    /// By light `[l]`; none of directional ones, and empty where there are no others.
    beams: Vec<Option<Beam>>,
}

/// Directions in which a light shines, each as likely as any other.
struct Beam {
    position: Vec3,
    axis: Vec3,
    cos_outer: f32,
    /// Of being the one of all beams that is taken.
    probability: f32,
}

impl Beams {
    pub(super) fn new(scene: &Scene) -> Self {
        let beam = |light: &crate::scene::Light| {
            let (position, axis, cos_outer) = match light.kind {
                LightKind::Point { position } => (position, Vec3::Y, -1.0),
                LightKind::Spot { position, direction, outer_angle, .. } => (position, direction, outer_angle.cos()),
                LightKind::Directional { .. } => return None,
            };
            let power = luminance(light.intensity) * (1.0 - cos_outer);
            (power > 0.0).then_some(Beam { position, axis, cos_outer, probability: power })
        };
        let mut beams: Vec<Option<Beam>> = scene.lights.iter().map(beam).collect();
        let whole: f32 = beams.iter().flatten().map(|beam| beam.probability).sum();
        beams.iter_mut().flatten().for_each(|beam| beam.probability /= whole);
        if beams.iter().all(Option::is_none) {
            beams.clear();
        }
        Self { beams }
    }

    /// No light can be close to anything.
    pub(super) fn is_empty(&self) -> bool {
        self.beams.is_empty()
    }

    /// One of the lights, the mightiest being the likeliest.
    fn choose(&self, mut number: f32) -> Option<(usize, &Beam)> {
        let mut last = None;
        for (light, beam) in self.beams.iter().enumerate() {
            let Some(beam) = beam else { continue };
            last = Some((light, beam));
            number -= beam.probability;
            if number < 0.0 {
                break;
            }
        }
        last
    }

    /// Density per steradian, seen from where `surface` was met at `distance`, with which a ray of `light` finds it.
    pub(super) fn density(&self, light: usize, arrival: &Arrival, surface: &Surface, distance: f32) -> f32 {
        let Some(Some(beam)) = self.beams.get(light) else { return 0.0 };
        let (cos_lit, cos_seen) = (surface.geometric.dot(arrival.to_light), surface.geometric.dot(surface.to_viewer));
        let per_area = beam.density() * cos_lit.max(0.0) / (arrival.distance * arrival.distance);
        per_area * distance * distance / cos_seen.max(f32::MIN_POSITIVE)
    }
}

impl Beam {
    /// Density of a direction, per steradian.
    fn density(&self) -> f32 {
        self.probability / (TAU * (1.0 - self.cos_outer))
    }

    fn ray(&self, sampler: &mut Sampler) -> Ray {
        let square = sampler.square();
        let cosine = 1.0 - square.x * (1.0 - self.cos_outer);
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let (sin, cos) = (TAU * square.y).sin_cos();
        let (tangent, bitangent) = tangent_frame(self.axis);
        let direction = tangent * (sine * cos) + bitangent * (sine * sin) + self.axis * cosine;
        Ray { origin: self.position, direction, chance: Chance::Only }
    }
}

impl PathTracer<'_> {
    /// Irradiance on a surface at `place`, with this shading normal and this geometric one, from a place that a ray of a
    /// punctual light meets, without the share that falls to a path whose direction has the `path_density`.
    pub(super) fn connected_irradiance(
        &self,
        place: Vec3,
        normal: Vec3,
        geometric: Vec3,
        path_density: impl Fn(Vec3) -> f32,
        sampler: &mut Sampler,
    ) -> Vec3 {
        let Some((light, beam)) = self.beams.choose(sampler.number()) else { return Vec3::ZERO };
        let Some(lit) = self.meet(&beam.ray(sampler), sampler) else { return Vec3::ZERO };
        let [a, b, c] = self.scene().corners(lit.triangle);
        let offset = a * lit.barycentric.x + b * lit.barycentric.y + c * lit.barycentric.z - place;
        let distance = offset.length();
        let direction = offset / distance.max(f32::MIN_POSITIVE);
        let is_front = edge_cross([a, b, c]).dot(direction) < 0.0;
        // Both must see the same side.
        if normal.dot(direction) <= 0.0 || geometric.dot(direction) <= 0.0 || is_front != lit.is_front {
            return Vec3::ZERO;
        }
        let density = path_density(direction);
        let ray = Ray { origin: place, direction, chance: Chance::Among { normal, density } };
        let surface = Surface::at(self.scene(), &ray, &Hit { distance, is_front, ..lit }, self.has_specular);
        let lit_place = self.above(surface.position, surface.geometric);
        let arrival = self.scene().lights[light].arrival(lit_place);
        let radiance = self.unhidden(&surface, &arrival);
        if radiance == Vec3::ZERO {
            return Vec3::ZERO;
        }
        let passing = self.passing(place, lit_place - place, 1.0);
        if passing.has_pane {
            return Vec3::ZERO;
        }
        let ours = self.beams.density(light, &arrival, &surface, distance);
        let theirs = density * self.lights.punctual_probability(light, lit_place, surface.normal);
        radiance * passing.share * (normal.dot(direction) * power_heuristic(ours, theirs) / ours)
    }
}
