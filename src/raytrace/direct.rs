//! Light straight from the lights to a surface: rays aimed at lamps, through panes too.

use std::cell::Cell;
use std::f32::consts::FRAC_1_PI;

use glam::Vec3;

use super::lights::EmitterSample;
use super::path::{Chance, PathTracer, Ray, power_heuristic};
use super::sampler::Sampler;
use super::surface::Surface;
use crate::scene::{Arrival, edge_cross};
use crate::trace::Hit;

/// Light that comes through between two places.
pub(super) struct Passing {
    pub share: Vec3,
    /// It comes through a pane.
    pub has_pane: bool,
}

impl Passing {
    /// The share, if it comes through a pane.
    fn share_of_panes(&self) -> Vec3 {
        if self.has_pane { self.share } else { Vec3::ZERO }
    }
}

impl PathTracer<'_> {
    /// Radiance towards the viewer of light straight from the lights: from every punctual one, and from one place on an
    /// emissive triangle; without the share of lamps in glossy metal that falls to rays which follow it.
    pub(super) fn direct(&self, surface: &Surface, sampler: &mut Sampler) -> Vec3 {
        let place = self.above(surface.position, surface.geometric);
        let punctual: Vec3 = self.lights.punctual(place).map(|arrival| self.reflected(surface, place, &arrival)).sum();
        punctual
            + self.reflected_of_emitters(surface, place, |direction| [0.0, surface.glossy_density(direction)], sampler)
    }

    /// As [`Self::direct`], from one of the punctual lights, and without the shares of light that fall to other ways to find
    /// it, where `surface` was met by `ray` at `distance`.
    pub(super) fn direct_beside_path(
        &self,
        surface: &Surface,
        ray: &Ray,
        distance: f32,
        sampler: &mut Sampler,
    ) -> Vec3 {
        let place = self.above(surface.position, surface.geometric);
        let mut radiance = Vec3::ZERO;
        if self.lights.has_punctual()
            && let Some((light, arrival, probability)) = self.lights.choose_punctual(place, surface.normal, sampler)
        {
            let unhidden = self.unhidden(surface, &arrival);
            if unhidden != Vec3::ZERO {
                let passing = self.passing(place, arrival.to_light, arrival.distance);
                let share = match ray.chance {
                    Chance::Among { density, .. } if !passing.has_pane => {
                        let connected = self.beams.density(light, &arrival, surface, distance);
                        power_heuristic(density * probability, connected)
                    }
                    _ => 1.0,
                };
                radiance += unhidden * passing.share * (share / probability);
            }
        }
        let densities = |direction| [surface.diffuse_density(direction), surface.scattered_glossy_density(direction)];
        radiance + self.reflected_of_emitters(surface, place, densities, sampler)
    }

    /// Radiance towards the viewer of a punctual light, with its highlight and its shadow.
    fn reflected(&self, surface: &Surface, place: Vec3, arrival: &Arrival) -> Vec3 {
        let unhidden = self.unhidden(surface, arrival);
        if unhidden == Vec3::ZERO {
            return Vec3::ZERO;
        }
        unhidden * self.passing(place, arrival.to_light, arrival.distance).share
    }

    /// Radiance towards the viewer of a punctual light, with its highlight, if nothing stood between.
    pub(super) fn unhidden(&self, surface: &Surface, arrival: &Arrival) -> Vec3 {
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

    /// Radiance towards the viewer of the emissive triangles, reflected diffusely and in glossy metal, without the shares
    /// that fall to rays followed either way, whose directions have the `path_densities`.
    fn reflected_of_emitters(
        &self,
        surface: &Surface,
        place: Vec3,
        path_densities: impl Fn(Vec3) -> [f32; 2],
        sampler: &mut Sampler,
    ) -> Vec3 {
        let is_glossy = surface.specular.as_ref().is_some_and(|specular| !specular.is_perfect());
        if !self.lights.has_emitters() || surface.reflectance == Vec3::ZERO && !is_glossy {
            return Vec3::ZERO;
        }
        let Some((sample, passing)) = self.emitter_sample(place, surface.normal, surface.geometric, sampler) else {
            return Vec3::ZERO;
        };
        let [diffuse, glossy] = path_densities(sample.direction);
        // Paths leave what comes through panes to the aimed rays, and reflections in metal keep it.
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

    /// Irradiance from the emissive triangles on a surface with this shading normal and this geometric one, by one sample,
    /// without the share that falls to a path whose direction has the `path_density`.
    pub(super) fn emitter_irradiance(
        &self,
        place: Vec3,
        normal: Vec3,
        geometric: Vec3,
        path_density: impl Fn(Vec3) -> f32,
        sampler: &mut Sampler,
    ) -> Vec3 {
        let Some((sample, passing)) = self.emitter_sample(place, normal, geometric, sampler) else {
            return Vec3::ZERO;
        };
        // Paths through panes leave all of it to the aimed rays.
        let shared = || power_heuristic(sample.density, path_density(sample.direction));
        let share = if passing.has_pane { 1.0 } else { shared() };
        sample.radiance * passing.share * (normal.dot(sample.direction) * share / sample.density)
    }

    /// A place on an emissive triangle that lies above the surface, and what passes from there.
    fn emitter_sample(
        &self,
        place: Vec3,
        normal: Vec3,
        geometric: Vec3,
        sampler: &mut Sampler,
    ) -> Option<(EmitterSample, Passing)> {
        let sample = self.lights.sample_emitter(place, normal, sampler)?;
        let is_above = geometric.dot(sample.direction) > 0.0;
        let to_lamp = self.above(sample.point, sample.normal) - place;
        is_above.then(|| (self.passing(place, to_lamp, 1.0), sample)).map(|(passing, sample)| (sample, passing))
    }

    /// Irradiance on a flat surface straight from all lights, as far as it comes through panes; one place on an emissive
    /// triangle is asked.
    pub(super) fn irradiance_through_panes(&self, place: Vec3, normal: Vec3, sampler: &mut Sampler) -> Vec3 {
        if !self.has_panes {
            return Vec3::ZERO;
        }
        let mut irradiance = Vec3::ZERO;
        for arrival in self.lights.punctual(place) {
            let cosine = normal.dot(arrival.to_light);
            if cosine > 0.0 {
                let passing = self.passing(place, arrival.to_light, arrival.distance);
                irradiance += arrival.irradiance * cosine * passing.share_of_panes();
            }
        }
        if let Some((sample, passing)) = self.emitter_sample(place, normal, normal, sampler) {
            let per_radiance = normal.dot(sample.direction) / sample.density;
            irradiance += sample.radiance * per_radiance * passing.share_of_panes();
        }
        irradiance
    }

    /// Share of light that passes along `direction` up to `max_distance`, through panes too.
    pub(super) fn passing(&self, origin: Vec3, direction: Vec3, max_distance: f32) -> Passing {
        if !self.has_panes {
            let share = self.tracer.transmittance(origin, direction, max_distance);
            return Passing { share: Vec3::splat(share), has_pane: false };
        }
        let has_pane = Cell::new(false);
        let ray = Ray { origin, direction: direction.normalize(), chance: Chance::Aimed };
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
