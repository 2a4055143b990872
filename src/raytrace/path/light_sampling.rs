//! Light straight from the lights to a surface, by rays aimed at them, through panes as well (next-event estimation).
//!
//! Equation: L = f L_e V cos / p, where the direction is sampled with density p, f is the reflectance distribution and
//! V the share of light that passes on the way. The power heuristic weights the sample where a path may find the same
//! light.

use std::cell::Cell;
use std::f32::consts::FRAC_1_PI;

use glam::Vec3;

use crate::raytrace::light::lights::EmitterSample;
use crate::raytrace::path::ray_caster::{RayCaster, power_heuristic};
use crate::raytrace::ray::{Ray, RaySource};
use crate::raytrace::sampler::Sampler;
use crate::raytrace::surface::hit::Surface;
use crate::scene::{Arrival, edge_cross};
use crate::trace::Hit;

/// Light that passes between two points.
pub(crate) struct Passing {
    /// Share that passes, per channel.
    pub share: Vec3,
    /// True if it passes a pane.
    pub has_pane: bool,
}

impl Passing {
    /// The share if light passes a pane, else 0.
    fn share_of_panes(&self) -> Vec3 {
        if self.has_pane { self.share } else { Vec3::ZERO }
    }
}

impl RayCaster<'_> {
    /// Radiance towards the viewer of light straight from the lights: from every punctual one, and from one point on an
    /// emissive triangle. Lamps in glossy metal are weighted for rays that follow the reflection.
    pub(crate) fn direct(&self, surface: &Surface, sampler: &mut Sampler) -> Vec3 {
        let origin = self.above(surface.position, surface.geometric);
        let punctual: Vec3 =
            self.lights.punctual(origin).map(|arrival| self.reflected(surface, origin, &arrival)).sum();
        punctual
            + self.reflected_of_emitters(surface, origin, |direction| [0.0, surface.glossy_density(direction)], sampler)
    }

    /// Returns the same radiance as [`Self::direct`], but from only one of the punctual lights, and weighted for the
    /// other strategies of a path that has hit `surface` by `ray` at `distance`.
    pub(crate) fn direct_beside_path(
        &self,
        surface: &Surface,
        ray: &Ray,
        distance: f32,
        sampler: &mut Sampler,
    ) -> Vec3 {
        let origin = self.above(surface.position, surface.geometric);
        let mut radiance = Vec3::ZERO;
        if self.lights.has_punctual()
            && let Some((light, arrival, probability)) = self.lights.choose_punctual(origin, surface.normal, sampler)
        {
            let unoccluded = self.unoccluded(surface, &arrival);
            if unoccluded != Vec3::ZERO {
                let passing = self.passing(origin, arrival.to_light, arrival.distance);
                let share = match ray.source {
                    RaySource::Diffuse { density, .. } if !passing.has_pane => {
                        let connected = self.beams.density(light, &arrival, surface, distance);
                        power_heuristic(density * probability, connected)
                    }
                    _ => 1.0,
                };
                radiance += unoccluded * passing.share * (share / probability);
            }
        }
        let densities = |direction| [surface.diffuse_density(direction), surface.scattered_glossy_density(direction)];
        radiance + self.reflected_of_emitters(surface, origin, densities, sampler)
    }

    /// Radiance towards the viewer of a punctual light, with its highlight and its shadow.
    fn reflected(&self, surface: &Surface, origin: Vec3, arrival: &Arrival) -> Vec3 {
        let unoccluded = self.unoccluded(surface, arrival);
        if unoccluded == Vec3::ZERO {
            return Vec3::ZERO;
        }
        unoccluded * self.passing(origin, arrival.to_light, arrival.distance).share
    }

    /// Radiance towards the viewer of a punctual light, with its highlight, without occlusion.
    pub(crate) fn unoccluded(&self, surface: &Surface, arrival: &Arrival) -> Vec3 {
        let cosine = surface.normal.dot(arrival.to_light);
        if cosine <= 0.0 || arrival.to_light.dot(surface.geometric) <= 0.0 {
            return Vec3::ZERO;
        }
        let mut share = surface.reflectance * (FRAC_1_PI * cosine);
        if let Some(specular) = &surface.specular {
            share += specular.highlight(surface.to_viewer, arrival.to_light);
        }
        share * arrival.irradiance
    }

    /// Radiance towards the viewer of the emissive triangles, reflected diffusely and in glossy metal. `path_densities`
    /// are the densities with which a path takes a direction by each of the two reflections; the path accounts for the
    /// rest of the light.
    fn reflected_of_emitters(
        &self,
        surface: &Surface,
        origin: Vec3,
        path_densities: impl Fn(Vec3) -> [f32; 2],
        sampler: &mut Sampler,
    ) -> Vec3 {
        let is_glossy = surface.specular.as_ref().is_some_and(|specular| !specular.is_perfect());
        if !self.lights.has_emitters() || surface.reflectance == Vec3::ZERO && !is_glossy {
            return Vec3::ZERO;
        }
        let Some((sample, passing)) = self.emitter_sample(origin, surface.normal, surface.geometric, sampler) else {
            return Vec3::ZERO;
        };
        let [diffuse, glossy] = path_densities(sample.direction);
        // Behind panes, aimed rays account for all diffuse light, and followed rays for all that metal reflects.
        let [to_diffuse, to_glossy] = if passing.has_pane {
            [1.0, 0.0]
        } else {
            [diffuse, glossy].map(|path| power_heuristic(sample.density, path))
        };
        let mut reflected = surface.reflectance * (FRAC_1_PI * surface.normal.dot(sample.direction) * to_diffuse);
        if let Some(specular) = surface.specular.as_ref().filter(|_| is_glossy) {
            reflected += specular.highlight(surface.to_viewer, sample.direction) * to_glossy;
        }
        reflected * sample.radiance * passing.share / sample.density
    }

    /// Irradiance from the emissive triangles at `origin`, above a surface with this shading and this geometric normal,
    /// estimated by one sample. `path_density` is the density with which a path takes a direction; the path accounts
    /// for the rest.
    pub(crate) fn emitter_irradiance(
        &self,
        origin: Vec3,
        normal: Vec3,
        geometric: Vec3,
        path_density: impl Fn(Vec3) -> f32,
        sampler: &mut Sampler,
    ) -> Vec3 {
        let Some((sample, passing)) = self.emitter_sample(origin, normal, geometric, sampler) else {
            return Vec3::ZERO;
        };
        // Behind panes, aimed rays account for all light.
        let shared = || power_heuristic(sample.density, path_density(sample.direction));
        let share = if passing.has_pane { 1.0 } else { shared() };
        sample.radiance * passing.share * (normal.dot(sample.direction) * share / sample.density)
    }

    /// Samples a point on an emissive triangle above the surface, and returns it with the share of light that passes
    /// from there.
    fn emitter_sample(
        &self,
        origin: Vec3,
        normal: Vec3,
        geometric: Vec3,
        sampler: &mut Sampler,
    ) -> Option<(EmitterSample, Passing)> {
        let sample = self.lights.sample_emitter(origin, normal, sampler)?;
        let is_above = geometric.dot(sample.direction) > 0.0;
        let to_lamp = self.above(sample.point, sample.normal) - origin;
        is_above.then(|| (self.passing(origin, to_lamp, 1.0), sample)).map(|(passing, sample)| (sample, passing))
    }

    /// Irradiance on a flat surface straight from all lights, but only the light that has passed panes, estimated by
    /// one sample of the emissive triangles.
    pub(crate) fn irradiance_through_panes(&self, origin: Vec3, normal: Vec3, sampler: &mut Sampler) -> Vec3 {
        if !self.has_panes {
            return Vec3::ZERO;
        }
        let mut irradiance = Vec3::ZERO;
        for arrival in self.lights.punctual(origin) {
            let cosine = normal.dot(arrival.to_light);
            if cosine > 0.0 {
                let passing = self.passing(origin, arrival.to_light, arrival.distance);
                irradiance += arrival.irradiance * cosine * passing.share_of_panes();
            }
        }
        if let Some((sample, passing)) = self.emitter_sample(origin, normal, normal, sampler) {
            let per_radiance = normal.dot(sample.direction) / sample.density;
            irradiance += sample.radiance * per_radiance * passing.share_of_panes();
        }
        irradiance
    }

    /// Returns the share of light that passes along `direction` up to `max_distance`, in multiples of the length of
    /// `direction`. Light also passes through panes.
    pub(crate) fn passing(&self, origin: Vec3, direction: Vec3, max_distance: f32) -> Passing {
        if !self.has_panes {
            let share = self.tracer.transmittance(origin, direction, max_distance);
            return Passing { share: Vec3::splat(share), has_pane: false };
        }
        let has_pane = Cell::new(false);
        let ray = Ray { origin, direction: direction.normalize(), source: RaySource::BehindPane };
        let share = self.tracer.coloured_transmittance(origin, direction, max_distance, |triangle, barycentric| {
            if self.scene().material_of(triangle).transmission <= 0.0 {
                return None;
            }
            let is_front = edge_cross(self.scene().corners(triangle)).dot(direction) < 0.0;
            let surface =
                Surface::at(self.scene(), &ray, &Hit { distance: 0.0, triangle, barycentric, is_front }, true);
            let passing = surface.specular.as_ref()?.passing(surface.to_viewer)?;
            has_pane.set(true);
            let opacity = self.scene().surface_at(triangle, barycentric).opacity;
            Some(passing * opacity + (1.0 - opacity))
        });
        Passing { share, has_pane: has_pane.get() }
    }
}
