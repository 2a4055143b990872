//! Path tracing: unbiased light along a ray, the truth that the other methods are judged by.
//!
//! At every diffuse or glossy surface light is sampled twice: at the lamps (next-event estimation) and by the path itself; each
//! lamp's light is shared between the two by the power heuristic. Punctual lights can only be aimed at, also through
//! panes, or followed to what is close to them; mirrors can only be followed: what a mirror throws of a punctual light is
//! left out.
//!
//! Sources: Kajiya 1986, "The Rendering Equation"; Veach 1997, "Robust Monte Carlo Methods for Light Transport
//! Simulation", chapter 9.

use std::f32::consts::FRAC_1_PI;

use glam::Vec3;

use super::connection::Beams;
use super::lights::Lights;
use super::sampler::Sampler;
use super::surface::{Surface, Way};
use crate::base::ids::TriangleId;
use crate::base::sampling::{hash, unit_float};
use crate::scene::{AlphaMode, Scene};
use crate::trace::{Hit, Tracer};

/// Height of a ray's origin above its surface, as a share of the scene's extent: above rounding, below detail.
const HEIGHT: f32 = 1e-5;

/// Reflections after which a path may end by chance.
const MIN_BOUNCES: u32 = 4;

/// Follows paths through a scene.
pub(super) struct PathTracer<'a> {
    pub tracer: &'a Tracer<'a>,
    pub lights: Lights<'a>,
    pub beams: Beams,
    max_bounces: u32,
    pub has_specular: bool,
    pub has_panes: bool,
    height: f32,
    has_blending: bool,
}

/// A ray, and how its direction came about.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    pub origin: Vec3,
    /// Unit vector.
    pub direction: Vec3,
    pub chance: Chance,
}

/// How a direction came about.
#[derive(Clone, Copy, Debug)]
pub(super) enum Chance {
    /// It is the eye's, which sees through the backs of single-sided surfaces, into a room from outside.
    Eye,
    /// Nothing else looks for lamps in this direction.
    Only,
    /// Lamps are sampled too, from a surface with this normal; density per steradian.
    Among { normal: Vec3, density: f32 },
    /// As [`Chance::Among`], by a reflection in metal: the eye sees through it.
    Glossy { normal: Vec3, density: f32 },
    /// It goes on through a pane from a surface that has looked for lamps behind panes itself.
    Aimed,
}

/// Radiance that arrives along a ray.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Arriving {
    /// From the surface that the ray meets.
    pub emitted: Vec3,
    /// Reflected there.
    pub reflected: Vec3,
}

impl Chance {
    /// The chance of a ray reflected in metal, in a direction of some density.
    pub(super) fn reflected(normal: Vec3, density: f32) -> Self {
        if density > 0.0 { Chance::Glossy { normal, density } } else { Chance::Only }
    }

    /// The chance of a ray that has passed a pane.
    pub(super) fn behind_pane(self) -> Self {
        match self {
            Chance::Among { .. } => Chance::Aimed,
            // What comes through panes is not aimed at for metal.
            Chance::Glossy { .. } => Chance::Only,
            other => other,
        }
    }
}

impl<'a> PathTracer<'a> {
    pub(super) fn new(tracer: &'a Tracer<'a>, max_bounces: u32, has_specular: bool) -> Self {
        let scene = tracer.scene();
        Self {
            tracer,
            lights: Lights::new(scene),
            beams: Beams::new(scene),
            max_bounces,
            has_specular,
            has_panes: has_specular && scene.materials.iter().any(|material| material.transmission > 0.0),
            height: HEIGHT * scene.bounds().extent(),
            has_blending: scene.materials.iter().any(|material| material.alpha_mode == AlphaMode::Blend),
        }
    }

    pub(super) fn scene(&self) -> &'a Scene {
        self.tracer.scene()
    }

    /// A point moved off its surface.
    pub(super) fn above(&self, point: Vec3, normal: Vec3) -> Vec3 {
        point + normal * self.height
    }

    /// What the ray meets; surfaces that blend are met as often as they are opaque.
    pub(super) fn meet(&self, ray: &Ray, sampler: &mut Sampler) -> Option<Hit> {
        let mut hit = self.nearest(ray.origin, ray.direction, sampler)?;
        while matches!(ray.chance, Chance::Eye) && !hit.is_front && !self.has_two_sides(hit.triangle) {
            let passed = hit.distance + self.height;
            hit = self.nearest(ray.origin + passed * ray.direction, ray.direction, sampler)?;
            hit.distance += passed;
        }
        Some(hit)
    }

    fn has_two_sides(&self, triangle: TriangleId) -> bool {
        let material = self.scene().material_of(triangle);
        material.double_sided || self.has_panes && material.transmission > 0.0
    }

    fn nearest(&self, origin: Vec3, direction: Vec3, sampler: &mut Sampler) -> Option<Hit> {
        if !self.has_blending {
            return self.tracer.nearest(origin, direction, f32::INFINITY);
        }
        let bits = sampler.bits();
        // Never 0: what is a hole must not be met.
        let solid_from = |triangle: TriangleId| 1.0 - unit_float(hash(bits ^ hash(triangle.0)));
        self.tracer.nearest_solid(origin, direction, f32::INFINITY, solid_from)
    }

    /// Radiance that arrives along a ray from the eye, estimated by one path; none from the open.
    pub(super) fn seen(&self, ray: Ray, sampler: &mut Sampler) -> Option<Vec3> {
        let hit = self.meet(&ray, sampler)?;
        let light = self.arriving_from(ray, Some(hit), sampler);
        Some(light.emitted + light.reflected)
    }

    /// Radiance that arrives along a ray, estimated by one path.
    pub(super) fn arriving(&self, ray: Ray, sampler: &mut Sampler) -> Arriving {
        let hit = self.meet(&ray, sampler);
        self.arriving_from(ray, hit, sampler)
    }

    /// Radiance that arrives along a ray from what it has met.
    fn arriving_from(&self, mut ray: Ray, mut met: Option<Hit>, sampler: &mut Sampler) -> Arriving {
        let mut light = Arriving::default();
        let mut throughput = Vec3::ONE;
        let mut bounce = 0;
        while let Some(hit) = met {
            let surface = Surface::at(self.scene(), &ray, &hit, self.has_specular);
            if surface.emission != Vec3::ZERO {
                let emitted = throughput * surface.emission * self.path_share(&ray, &hit);
                *(if bounce == 0 { &mut light.emitted } else { &mut light.reflected }) += emitted;
            }
            if bounce == self.max_bounces {
                break;
            }
            light.reflected += throughput * self.direct_beside_path(&surface, &ray, hit.distance, sampler);
            if self.connects_at(bounce + 1) && surface.reflectance != Vec3::ZERO {
                light.reflected += throughput * self.connected(&surface, sampler);
            }
            let Some(scattered) = surface.scatter(sampler) else { break };
            throughput *= scattered.throughput;
            let chance = match scattered.way {
                Way::Diffuse { density } => Chance::Among { normal: surface.normal, density },
                Way::Reflected { density } => Chance::reflected(surface.normal, density),
                Way::Passed => ray.chance.behind_pane(),
            };
            ray = self.onward(&surface, scattered.direction, chance);
            if bounce >= MIN_BOUNCES && !survives(&mut throughput, sampler) {
                break;
            }
            bounce += u32::from(!matches!(scattered.way, Way::Passed));
            met = self.meet(&ray, sampler);
        }
        light
    }

    /// Light of punctual lights is looked for that the surface at a bounce would reflect.
    pub(super) fn connects_at(&self, bounce: u32) -> bool {
        !self.beams.is_empty() && bounce < self.max_bounces
    }

    /// Radiance towards the viewer that a surface reflects diffusely of the light that punctual lights throw on another.
    fn connected(&self, surface: &Surface, sampler: &mut Sampler) -> Vec3 {
        let place = self.above(surface.position, surface.geometric);
        let density = |direction| surface.diffuse_density(direction);
        let irradiance = self.connected_irradiance(place, surface.normal, surface.geometric, density, sampler);
        surface.reflectance * FRAC_1_PI * irradiance
    }

    /// The ray that goes on from a surface.
    pub(super) fn onward(&self, surface: &Surface, direction: Vec3, chance: Chance) -> Ray {
        let side = surface.geometric * direction.dot(surface.geometric).signum();
        Ray { origin: self.above(surface.position, side), direction, chance }
    }

    /// Share of the emission of what a ray has met that the path accounts for; the rest is sampled at the lamps.
    pub(super) fn path_share(&self, ray: &Ray, hit: &Hit) -> f32 {
        match ray.chance {
            Chance::Eye | Chance::Only => 1.0,
            Chance::Aimed => 0.0,
            Chance::Among { normal, density } | Chance::Glossy { normal, density } => {
                let at_lamps = self.lights.density(ray.origin, normal, ray.direction, hit.triangle, hit.distance);
                power_heuristic(density, at_lamps)
            }
        }
    }
}

/// Share of a sample of density `ours` where `theirs` could have taken it too (Veach 1997, section 9.2).
pub(super) fn power_heuristic(ours: f32, theirs: f32) -> f32 {
    let ratio = theirs / ours;
    1.0 / (1.0 + ratio * ratio)
}

/// Russian roulette: a path that carries little ends by chance; one that goes on carries what the ended ones would have.
pub(super) fn survives(throughput: &mut Vec3, sampler: &mut Sampler) -> bool {
    let chance = throughput.max_element().min(0.95);
    let is_alive = sampler.number() < chance;
    if is_alive {
        *throughput /= chance;
    }
    is_alive
}
