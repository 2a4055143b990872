//! The second pass: ray tracing that takes its ambient light from radiosity.
//!
//! From the eye to the first diffuse surface everything depends on the view and is traced: direct light with shadow rays,
//! mirrors, glossy metal, panes. What reaches that surface indirectly does not, and was solved in the first pass, but for
//! what mirrors throw, which is solved here before the first ray. With a constant in place of indirect light this is the
//! classic ray tracing of Whitted 1980.
//!
//! Sources: Whitted 1980, "An Improved Illumination Model for Shaded Display"; Wallace, Cohen, Greenberg 1987, "A Two-pass
//! Solution to the Rendering Equation"; Smits, Arvo, Salesin 1992 (the final gather).

use std::f32::consts::{FRAC_1_PI, PI};

use glam::Vec3;

use super::film::Film;
use super::mirrors::follow;
use super::path::{Chance, PathTracer, Ray};
use super::sampler::Sampler;
use super::settings::{Ambient, TwoPassSettings};
use super::stored::StoredLight;
use super::surface::Surface;
use super::thrown::{has_mirrors, thrown_light};
use crate::baked::BakedScene;
use crate::base::progress::Progress;
use crate::base::sampling::cosine_hemisphere;
use crate::scene::Camera;
use crate::trace::Tracer;

/// A picture of a baked scene, whose elements `tracer` holds; without a sample where it was cancelled.
#[must_use]
pub fn two_pass(
    tracer: &Tracer<'_>,
    baked: &BakedScene,
    camera: &Camera,
    size: [u32; 2],
    settings: &TwoPassSettings,
    progress: &dyn Progress,
) -> Film {
    let mut film = Film::new(size);
    if let Some(second) = SecondPass::new(tracer, baked, settings, progress) {
        second.refine(&mut film, camera, settings.samples, progress);
    }
    film
}

/// The second pass over a bake, ready for pictures from any viewpoint.
///
/// For a picture that gets better while it is looked at: [`Self::refine`] a [`Film`] by a few samples at a time and show
/// [`Film::radiance`] after each.
pub struct SecondPass<'a> {
    rays: PathTracer<'a>,
    stored: StoredLight<'a>,
    settings: TwoPassSettings,
}

impl<'a> SecondPass<'a> {
    /// Prepares the second pass over `baked`, whose elements `tracer` holds. None where it was cancelled.
    ///
    /// Cost: seconds where there are mirrors or panes, whose light is solved here; else next to nothing.
    #[must_use]
    pub fn new(
        tracer: &'a Tracer<'a>,
        baked: &'a BakedScene,
        settings: &TwoPassSettings,
        progress: &dyn Progress,
    ) -> Option<Self> {
        let (rays, mut stored) = (PathTracer::new(tracer, 0, true), StoredLight::new(baked));
        if matches!(settings.ambient, Ambient::Indirect { .. }) && has_mirrors(rays.scene()) {
            let thrown = thrown_light(&rays, &stored, progress)?;
            stored.add(&thrown);
        }
        Some(Self { rays, stored, settings: *settings })
    }

    /// Adds `samples` rays a pixel to a picture. False where it was cancelled: the picture is then as it was before.
    pub fn refine(&self, film: &mut Film, camera: &Camera, samples: u32, progress: &dyn Progress) -> bool {
        film.refine(camera, samples, self.settings.seed, progress, |ray, sampler| self.seen(ray, sampler))
    }

    /// Radiance along a ray from the eye, through mirrors; none from the open.
    fn seen(&self, ray: Ray, sampler: &mut Sampler) -> Option<Vec3> {
        let mut radiance = Vec3::ZERO;
        let prepare = |surface: &mut Surface| self.simplify(surface);
        let num_met = follow(&self.rays, ray, sampler, prepare, |surface, trail, sampler| {
            let emission_share = if self.traces_lights() { trail.emission_share } else { 1.0 };
            radiance += trail.throughput * (surface.emission * emission_share + self.reflected(surface, sampler));
        });
        (num_met > 0).then_some(radiance)
    }

    /// Lights are aimed at.
    fn traces_lights(&self) -> bool {
        self.settings.ambient != Ambient::All
    }

    /// Whitted's metal is a mirror or nothing.
    fn simplify(&self, surface: &mut Surface) {
        if matches!(self.settings.ambient, Ambient::Constant(_)) {
            surface.specular.take_if(|specular| !specular.is_perfect());
        }
    }

    /// Light of the lights and of the surroundings that a surface reflects towards the viewer, but for what its mirror
    /// shows.
    fn reflected(&self, surface: &Surface, sampler: &mut Sampler) -> Vec3 {
        let per_irradiance = surface.reflectance * FRAC_1_PI;
        match self.settings.ambient {
            Ambient::All => per_irradiance * self.stored.total(surface),
            Ambient::None => self.rays.direct(surface, sampler),
            Ambient::Constant(radiance) => surface.reflectance * radiance + self.rays.direct(surface, sampler),
            Ambient::Indirect { final_gather } => {
                let indirect = match final_gather {
                    0 => self.stored.indirect(surface),
                    _ => {
                        PI / final_gather as f32
                            * (0..final_gather).map(|_| self.gathered(surface, sampler)).sum::<Vec3>()
                    }
                };
                per_irradiance * (indirect + self.stored.by_mirrors(surface)) + self.rays.direct(surface, sampler)
            }
        }
    }

    /// Indirect radiance from one direction of the hemisphere, as likely as its cosine: what the surface in it reflects of
    /// the stored light. Lamps are direct light, and what mirrors throw of them is stored.
    fn gathered(&self, surface: &Surface, sampler: &mut Sampler) -> Vec3 {
        if surface.reflectance == Vec3::ZERO {
            return Vec3::ZERO;
        }
        let direction = cosine_hemisphere(surface.normal, sampler.square());
        if direction.dot(surface.geometric) <= 0.0 {
            return Vec3::ZERO;
        }
        let ray = self.rays.onward(surface, direction, Chance::Only);
        let mut radiance = Vec3::ZERO;
        follow(
            &self.rays,
            ray,
            sampler,
            |_| {},
            |met, trail, _| {
                radiance += trail.throughput * met.reflectance * FRAC_1_PI * self.stored.total(met);
            },
        );
        radiance
    }
}
