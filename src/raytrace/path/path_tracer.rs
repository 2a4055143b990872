//! Path tracing: an unbiased estimate of the light along a ray, the reference for the other methods.
//!
//! Equation: L_o = L_e + integral of f L_i cos over the directions (the rendering equation), followed recursively along
//! one random direction at each surface.
//!
//! The light of lamps is sampled twice at every diffuse or glossy surface: by a point on a lamp (next-event estimation)
//! and by the direction in which the path continues. The power heuristic weights the two. Paths cannot hit punctual
//! lights, which have no area. They are sampled directly, also through panes, and by connection with a surface that a
//! ray from the light hits (`connection.rs`). Light of a punctual light by way of a mirror is left out, because no
//! strategy finds it.
//!
//! Sources: Kajiya 1986, "The Rendering Equation"; Veach 1997, "Robust Monte Carlo Methods for Light Transport
//! Simulation", chapter 9.

use std::f32::consts::FRAC_1_PI;

use glam::Vec3;

use crate::base::progress::Progress;
use crate::raytrace::film::Film;
use crate::raytrace::path::ray_caster::RayCaster;
use crate::raytrace::ray::{Ray, RaySource};
use crate::raytrace::sampler::Sampler;
use crate::raytrace::settings::PathSettings;
use crate::raytrace::surface::hit::{Surface, Way};
use crate::scene::Camera;
use crate::trace::{Hit, Tracer};

/// Number of reflections after which Russian roulette may end a path.
const MIN_BOUNCES: u32 = 4;

/// Renders a picture by path tracing, unbiased. Returns a film without samples if it was cancelled.
#[must_use]
pub fn path_traced(
    tracer: &Tracer<'_>,
    camera: &Camera,
    size: [u32; 2],
    settings: &PathSettings,
    progress: &dyn Progress,
) -> Film {
    let paths = PathTracer::new(tracer, settings);
    let mut film = Film::new(size);
    film.refine(camera, settings.samples, settings.seed, progress, |ray, sampler| paths.seen(ray, sampler));
    film
}

/// Follows paths through a scene.
pub(crate) struct PathTracer<'a> {
    pub rays: RayCaster<'a>,
    max_bounces: u32,
}

/// Radiance that arrives along a ray.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Arriving {
    /// Emitted by the surface that the ray hits.
    pub emitted: Vec3,
    /// Reflected by that surface.
    pub reflected: Vec3,
}

impl<'a> PathTracer<'a> {
    pub(crate) fn new(tracer: &'a Tracer<'a>, settings: &PathSettings) -> Self {
        Self { rays: RayCaster::new(tracer, settings.has_specular), max_bounces: settings.max_bounces }
    }

    /// Radiance that arrives along a camera ray, estimated by one path. `None` if the ray leaves the scene.
    fn seen(&self, ray: Ray, sampler: &mut Sampler) -> Option<Vec3> {
        let hit = self.rays.meet(&ray, sampler)?;
        let light = self.arriving_from(ray, Some(hit), sampler);
        Some(light.emitted + light.reflected)
    }

    /// Radiance that arrives along a ray, estimated by one path.
    pub(crate) fn arriving(&self, ray: Ray, sampler: &mut Sampler) -> Arriving {
        let hit = self.rays.meet(&ray, sampler);
        self.arriving_from(ray, hit, sampler)
    }

    /// Radiance that arrives along a ray from its hit.
    fn arriving_from(&self, mut ray: Ray, mut met: Option<Hit>, sampler: &mut Sampler) -> Arriving {
        let rays = &self.rays;
        let mut light = Arriving::default();
        let mut throughput = Vec3::ONE;
        let mut bounce = 0;
        while let Some(hit) = met {
            let surface = Surface::at(rays.scene(), &ray, &hit, rays.has_specular);
            if surface.emission != Vec3::ZERO {
                let emitted = throughput * surface.emission * rays.emission_share(&ray, &hit);
                *(if bounce == 0 { &mut light.emitted } else { &mut light.reflected }) += emitted;
            }
            if bounce == self.max_bounces {
                break;
            }
            light.reflected += throughput * rays.direct_beside_path(&surface, &ray, hit.distance, sampler);
            if self.connects_at(bounce + 1) && surface.reflectance != Vec3::ZERO {
                light.reflected += throughput * self.connected(&surface, sampler);
            }
            let Some(scattered) = surface.scatter(sampler) else { break };
            throughput *= scattered.throughput;
            let source = match scattered.way {
                Way::Diffuse { density } => RaySource::Diffuse { normal: surface.normal, density },
                Way::Reflected { density } => RaySource::reflected(surface.normal, density),
                Way::Passed => ray.source.behind_pane(),
            };
            ray = rays.onward(&surface, scattered.direction, source);
            if bounce >= MIN_BOUNCES && !survives(&mut throughput, sampler) {
                break;
            }
            bounce += u32::from(!matches!(scattered.way, Way::Passed));
            met = rays.meet(&ray, sampler);
        }
        light
    }

    /// Returns true if the surface at a bounce is connected with surfaces that rays of punctual lights hit.
    pub(crate) fn connects_at(&self, bounce: u32) -> bool {
        !self.rays.beams.is_empty() && bounce < self.max_bounces
    }

    /// Radiance towards the viewer that a surface reflects diffusely. The light comes from another surface, on which
    /// punctual lights cast it.
    fn connected(&self, surface: &Surface, sampler: &mut Sampler) -> Vec3 {
        let origin = self.rays.above(surface.position, surface.geometric);
        let density = |direction| surface.diffuse_density(direction);
        let irradiance = self.rays.connected_irradiance(origin, surface.normal, surface.geometric, density, sampler);
        surface.reflectance * FRAC_1_PI * irradiance
    }
}

/// Russian roulette: randomly ends a path that carries little light, and returns false if it ended.
///
/// A path that goes on carries the light of the ended ones as well: throughput / p, where p is the probability to go
/// on, so that the mean stays the same.
fn survives(throughput: &mut Vec3, sampler: &mut Sampler) -> bool {
    let probability = throughput.max_element().min(0.95);
    let is_alive = sampler.number() < probability;
    if is_alive {
        *throughput /= probability;
    }
    is_alive
}
