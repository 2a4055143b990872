//! The second pass: ray tracing with ambient light from radiosity.
//!
//! Light between the camera and the first diffuse surface depends on the view and is traced: direct light with shadow
//! rays, mirrors, glossy metal, panes. Indirect light at that surface does not depend on the view and is solved in the
//! first pass, radiosity; caustics, which radiosity lacks, are solved here before the first ray. With a constant in
//! place of indirect light this is the classic ray tracing of Whitted 1980.
//!
//! Sources: Whitted 1980, "An Improved Illumination Model for Shaded Display"; Wallace, Cohen, Greenberg 1987, "A
//! Two-pass Solution to the Rendering Equation"; Smits, Arvo, Salesin 1992 (the final gather).

use std::f32::consts::{FRAC_1_PI, PI};

use glam::Vec3;

use crate::baked::BakedScene;
use crate::base::progress::Progress;
use crate::base::sampling::cosine_hemisphere;
use crate::raytrace::caustics::caustic_light::{caustic_light, has_mirrors};
use crate::raytrace::film::Film;
use crate::raytrace::path::ray_caster::RayCaster;
use crate::raytrace::path::specular_chain::follow;
use crate::raytrace::ray::{Ray, RaySource};
use crate::raytrace::sampler::Sampler;
use crate::raytrace::settings::{Ambient, TwoPassSettings};
use crate::raytrace::stored_light::StoredLight;
use crate::raytrace::surface::hit::Surface;
use crate::scene::Camera;
use crate::trace::Tracer;

/// Renders a picture of a baked scene. Returns a film without samples if it was cancelled.
///
/// `tracer` must hold the elements of `baked`.
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
/// For a picture that improves while it is on the screen, [`Self::refine`] a [`Film`] by a few samples at a time and
/// show [`Film::radiance`] after each call.
pub struct SecondPass<'a> {
    rays: RayCaster<'a>,
    stored: StoredLight<'a>,
    settings: TwoPassSettings,
}

impl<'a> SecondPass<'a> {
    /// Prepares the second pass over `baked`. Returns `None` if it was cancelled.
    ///
    /// `tracer` must hold the elements of `baked`. Cost: seconds if there are mirrors or panes, whose caustics are
    /// solved here; else negligible.
    #[must_use]
    pub fn new(
        tracer: &'a Tracer<'a>,
        baked: &'a BakedScene,
        settings: &TwoPassSettings,
        progress: &dyn Progress,
    ) -> Option<Self> {
        let (rays, mut stored) = (RayCaster::new(tracer, true), StoredLight::new(baked));
        if matches!(settings.ambient, Ambient::Indirect { .. }) && has_mirrors(rays.scene()) {
            let caustics = caustic_light(&rays, &stored, progress)?;
            stored.add(&caustics);
        }
        Some(Self { rays, stored, settings: *settings })
    }

    /// Adds `samples` rays a pixel to a picture. If it is cancelled, the picture stays unchanged and the result is
    /// false.
    pub fn refine(&self, film: &mut Film, camera: &Camera, samples: u32, progress: &dyn Progress) -> bool {
        film.refine(camera, samples, self.settings.seed, progress, |ray, sampler| self.seen(ray, sampler))
    }

    /// Returns the radiance along a camera ray, through mirrors, or `None` if the ray leaves the scene.
    fn seen(&self, ray: Ray, sampler: &mut Sampler) -> Option<Vec3> {
        let mut radiance = Vec3::ZERO;
        let prepare = |surface: &mut Surface| self.simplify(surface);
        let num_met = follow(&self.rays, ray, sampler, prepare, |surface, chain, sampler| {
            let emission_share = if self.traces_lights() { chain.emission_share } else { 1.0 };
            radiance += chain.throughput * (surface.emission * emission_share + self.reflected(surface, sampler));
        });
        (num_met > 0).then_some(radiance)
    }

    /// Returns true if direct light is traced and not taken from the bake.
    fn traces_lights(&self) -> bool {
        self.settings.ambient != Ambient::All
    }

    /// With constant ambient light, as in Whitted 1980, metal is a perfect mirror or not specular at all.
    fn simplify(&self, surface: &mut Surface) {
        if matches!(self.settings.ambient, Ambient::Constant(_)) {
            surface.specular.take_if(|specular| !specular.is_perfect());
        }
    }

    /// Radiance towards the viewer of direct and ambient light, without mirror images.
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

    /// Indirect radiance from one cosine-distributed direction of the hemisphere: what the surface there reflects of
    /// the stored light. Emission does not count, because lamps are direct light.
    fn gathered(&self, surface: &Surface, sampler: &mut Sampler) -> Vec3 {
        if surface.reflectance == Vec3::ZERO {
            return Vec3::ZERO;
        }
        let direction = cosine_hemisphere(surface.normal, sampler.square());
        if direction.dot(surface.geometric) <= 0.0 {
            return Vec3::ZERO;
        }
        let ray = self.rays.onward(surface, direction, RaySource::Unshared);
        let mut radiance = Vec3::ZERO;
        follow(
            &self.rays,
            ray,
            sampler,
            |_| {},
            |met, chain, _| {
                radiance += chain.throughput * met.reflectance * FRAC_1_PI * self.stored.total(met);
            },
        );
        radiance
    }
}
