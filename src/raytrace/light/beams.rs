//! Rays that leave punctual lights, used to find surfaces close to a light.

use std::f32::consts::TAU;

use glam::Vec3;

use crate::base::colour::luminance;
use crate::base::sampling::tangent_frame;
use crate::raytrace::ray::{Ray, RaySource};
use crate::raytrace::sampler::Sampler;
use crate::raytrace::surface::hit::Surface;
use crate::scene::{Arrival, Light, LightKind, Scene};

/// The directions in which the point and spot lights of a scene shine.
pub(crate) struct Beams {
    /// Beams by light `[l]`; `None` for a directional light. Empty if all lights are directional.
    beams: Vec<Option<Beam>>,
}

/// A cone of directions, all equally likely.
struct Beam {
    position: Vec3,
    axis: Vec3,
    cos_outer: f32,
    /// Probability with which this beam is chosen among all.
    probability: f32,
}

impl Beams {
    pub(crate) fn new(scene: &Scene) -> Self {
        let beam = |light: &Light| {
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

    /// Returns true if there are no point or spot lights.
    pub(crate) fn is_empty(&self) -> bool {
        self.beams.is_empty()
    }

    /// Returns a ray of one of the lights, chosen by power, and the number of the light.
    pub(crate) fn ray(&self, sampler: &mut Sampler) -> Option<(usize, Ray)> {
        let (light, beam) = self.choose(sampler.number())?;
        Some((light, beam.ray(sampler)))
    }

    /// Chooses one of the lights by power.
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

    /// A point's ray hits `surface` at `distance`. Returns the density, per steradian at that point, with which a ray
    /// that leaves `light` finds the same place.
    ///
    /// Equation: p = p_light cos_lit / r_light^2 x r^2 / cos_seen, converted from solid angle at the light to area, and
    /// from area to solid angle at the point.
    pub(crate) fn density(&self, light: usize, arrival: &Arrival, surface: &Surface, distance: f32) -> f32 {
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
        Ray { origin: self.position, direction, source: RaySource::Unshared }
    }
}
