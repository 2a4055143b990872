//! Rays through a scene with its lights: the nearest hit, and the multiple importance sampling weight of emission
//! there.

use glam::Vec3;

use crate::base::ids::TriangleId;
use crate::base::sampling::{hash, unit_float};
use crate::raytrace::light::beams::Beams;
use crate::raytrace::light::lights::Lights;
use crate::raytrace::ray::{Ray, RaySource};
use crate::raytrace::sampler::Sampler;
use crate::raytrace::surface::hit::Surface;
use crate::scene::{AlphaMode, Scene};
use crate::trace::{Hit, Tracer};

/// Height of a ray's origin above its surface, as a share of the scene's extent: larger than rounding errors, smaller
/// than detail.
const HEIGHT: f32 = 1e-5;

/// Casts rays through a scene.
pub(crate) struct RayCaster<'a> {
    pub tracer: &'a Tracer<'a>,
    pub lights: Lights<'a>,
    pub beams: Beams,
    /// True if metals and panes reflect or transmit light.
    pub has_specular: bool,
    /// True if there are panes that transmit light.
    pub has_panes: bool,
    /// Height of a ray's origin above its surface, metres.
    height: f32,
    has_blending: bool,
}

impl<'a> RayCaster<'a> {
    pub(crate) fn new(tracer: &'a Tracer<'a>, has_specular: bool) -> Self {
        let scene = tracer.scene();
        Self {
            tracer,
            lights: Lights::new(scene),
            beams: Beams::new(scene),
            has_specular,
            has_panes: has_specular && scene.materials.iter().any(|material| material.transmission > 0.0),
            height: HEIGHT * scene.bounds().extent(),
            has_blending: scene.materials.iter().any(|material| material.alpha_mode == AlphaMode::Blend),
        }
    }

    pub(crate) fn scene(&self) -> &'a Scene {
        self.tracer.scene()
    }

    /// Returns a point moved off its surface, so that a ray from there does not hit the surface itself.
    pub(crate) fn above(&self, point: Vec3, normal: Vec3) -> Vec3 {
        point + normal * self.height
    }

    /// Returns the ray that leaves a surface in a direction to either side.
    pub(crate) fn onward(&self, surface: &Surface, direction: Vec3, source: RaySource) -> Ray {
        let side = surface.geometric * direction.dot(surface.geometric).signum();
        Ray { origin: self.above(surface.position, side), direction, source }
    }

    /// Returns the nearest hit of a ray. The probability that a blended surface is hit equals its opacity. Camera rays
    /// pass through the backs of single-sided surfaces.
    pub(crate) fn meet(&self, ray: &Ray, sampler: &mut Sampler) -> Option<Hit> {
        let mut hit = self.nearest(ray.origin, ray.direction, sampler)?;
        while matches!(ray.source, RaySource::Camera) && !hit.is_front && !self.has_two_sides(hit.triangle) {
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
        // The threshold is never 0, because a ray could then hit a hole, whose opacity is 0.
        let solid_from = |triangle: TriangleId| 1.0 - unit_float(hash(bits ^ hash(triangle.0)));
        self.tracer.nearest_solid(origin, direction, f32::INFINITY, solid_from)
    }

    /// Returns the multiple importance sampling weight of the emission at `hit`. Samples of the lamps have the
    /// remaining weight.
    pub(crate) fn emission_share(&self, ray: &Ray, hit: &Hit) -> f32 {
        match ray.source {
            RaySource::Camera | RaySource::Unshared => 1.0,
            RaySource::BehindPane => 0.0,
            RaySource::Diffuse { normal, density } | RaySource::Glossy { normal, density } => {
                let at_lamps = self.lights.density(ray.origin, normal, ray.direction, hit.triangle, hit.distance);
                power_heuristic(density, at_lamps)
            }
        }
    }
}

/// The power heuristic: the weight of a sample with density `ours` where another strategy has density `theirs`.
///
/// Equation: w = p_ours^2 / (p_ours^2 + p_theirs^2). For every direction, the weights of both strategies sum to one, so
/// the sum of the weighted samples is unbiased. The strategy with the higher density dominates, because its estimate
/// has less noise.
///
/// Source: Veach 1997, section 9.2.
pub(crate) fn power_heuristic(ours: f32, theirs: f32) -> f32 {
    let ratio = theirs / ours;
    1.0 / (1.0 + ratio * ratio)
}
