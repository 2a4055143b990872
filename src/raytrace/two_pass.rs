//! The second pass: ray tracing that takes its ambient light from radiosity.
//!
//! From the eye to the first diffuse surface everything depends on the view and is traced: direct light with shadow rays,
//! mirrors, glossy metal, panes. What reaches that surface indirectly does not, and was solved in the first pass. With a
//! constant in its place this is the classic ray tracing of Whitted 1980.
//!
//! Sources: Whitted 1980, "An Improved Illumination Model for Shaded Display"; Wallace, Cohen, Greenberg 1987, "A Two-pass
//! Solution to the Rendering Equation"; Smits, Arvo, Salesin 1992 (the final gather).

use std::f32::consts::FRAC_1_PI;

use glam::Vec3;

use super::film::Film;
use super::path::{Chance, PathTracer, Ray};
use super::sampler::Sampler;
use super::settings::{Ambient, TwoPassSettings};
use super::stored::StoredLight;
use super::surface::Surface;
use crate::baked::BakedScene;
use crate::base::progress::Progress;
use crate::base::sampling::cosine_hemisphere;
use crate::scene::Camera;
use crate::trace::Tracer;

/// Mirrors in a row that are followed.
const MAX_MIRRORS: u32 = 12;

/// A picture of a baked scene, whose elements `tracer` holds; what was not reached when it was cancelled is empty.
#[must_use]
pub fn two_pass(
    tracer: &Tracer<'_>,
    baked: &BakedScene,
    camera: &Camera,
    size: [u32; 2],
    settings: &TwoPassSettings,
    progress: &dyn Progress,
) -> Film {
    let second = SecondPass { rays: PathTracer::new(tracer, 0, true), stored: StoredLight::new(baked), settings };
    Film::trace(camera, size, settings.samples, settings.seed, progress, |ray, sampler| second.seen(ray, sampler))
}

struct SecondPass<'a> {
    rays: PathTracer<'a>,
    stored: StoredLight<'a>,
    settings: &'a TwoPassSettings,
}

impl SecondPass<'_> {
    /// Radiance along a ray from the eye, through mirrors; none from the open.
    fn seen(&self, mut ray: Ray, sampler: &mut Sampler) -> Option<Vec3> {
        let mut radiance = Vec3::ZERO;
        let mut throughput = Vec3::ONE;
        for mirrors in 0..=MAX_MIRRORS {
            let Some(surface) = self.meet(&ray, sampler) else {
                return (mirrors > 0).then_some(radiance);
            };
            radiance += throughput * (surface.emission + self.reflected(&surface, sampler));
            let Some(specular) = &surface.specular else { break };
            let Some((direction, share)) = specular.scatter(surface.to_viewer, surface.geometric, sampler) else {
                break;
            };
            throughput *= share;
            ray = self.rays.onward(&surface, direction, Chance::Only);
        }
        Some(radiance)
    }

    fn meet(&self, ray: &Ray, sampler: &mut Sampler) -> Option<Surface> {
        let hit = self.rays.meet(ray, sampler)?;
        let mut surface = Surface::at(self.rays.scene(), ray, &hit, true);
        // Whitted's metal is a mirror or nothing.
        if matches!(self.settings.ambient, Ambient::Constant(_)) {
            surface.specular = surface.specular.filter(|specular| specular.is_perfect());
        }
        Some(surface)
    }

    /// Light of the lights and of the surroundings that a surface reflects towards the viewer, but for what its mirror
    /// shows.
    fn reflected(&self, surface: &Surface, sampler: &mut Sampler) -> Vec3 {
        let per_irradiance = surface.reflectance * FRAC_1_PI;
        match self.settings.ambient {
            Ambient::All => per_irradiance * self.stored.total(surface),
            Ambient::None => self.rays.direct(surface, sampler),
            Ambient::Constant(radiance) => surface.reflectance * radiance + self.rays.direct(surface, sampler),
            Ambient::Indirect { final_gather: 0 } => {
                per_irradiance * self.stored.indirect(surface) + self.rays.direct(surface, sampler)
            }
            Ambient::Indirect { final_gather } => {
                let gathered: Vec3 = (0..final_gather).map(|_| self.gathered(surface, sampler)).sum();
                surface.reflectance * gathered / final_gather as f32 + self.rays.direct(surface, sampler)
            }
        }
    }

    /// Indirect radiance from one direction of the hemisphere, as likely as its cosine: what the surface in it reflects of
    /// the stored light. Lamps are direct light, unless a mirror shows them.
    fn gathered(&self, surface: &Surface, sampler: &mut Sampler) -> Vec3 {
        if surface.reflectance == Vec3::ZERO {
            return Vec3::ZERO;
        }
        let direction = cosine_hemisphere(surface.normal, sampler.square());
        if direction.dot(surface.geometric) <= 0.0 {
            return Vec3::ZERO;
        }
        let mut ray = self.rays.onward(surface, direction, Chance::Only);
        let mut radiance = Vec3::ZERO;
        let mut throughput = Vec3::ONE;
        for mirrors in 0..=MAX_MIRRORS {
            let Some(met) = self.meet(&ray, sampler) else { break };
            let emission = if mirrors > 0 { met.emission } else { Vec3::ZERO };
            radiance += throughput * (emission + met.reflectance * FRAC_1_PI * self.stored.total(&met));
            let Some(specular) = &met.specular else { break };
            let Some((direction, share)) = specular.scatter(met.to_viewer, met.geometric, sampler) else { break };
            throughput *= share;
            ray = self.rays.onward(&met, direction, Chance::Only);
        }
        radiance
    }
}
