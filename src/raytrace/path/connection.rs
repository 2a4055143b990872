//! Connects a surface with another surface that a ray from a point or spot light hits.
//!
//! A light beside a ceiling makes a small, very bright spot there. Paths from elsewhere seldom hit the spot. Their
//! estimates have a long tail, and their estimated error is too small as long as no path has hit it. So every diffuse
//! surface is also connected with the surface that a ray from a light hits, and the power heuristic weights both
//! strategies.
//!
//! Source: Veach 1997, chapter 10 (bidirectional path tracing; here the paths with two vertices from the light).

use glam::Vec3;

use crate::base::triangle::interpolate;
use crate::raytrace::path::ray_caster::{RayCaster, power_heuristic};
use crate::raytrace::ray::{Ray, RaySource};
use crate::raytrace::sampler::Sampler;
use crate::raytrace::surface::hit::Surface;
use crate::scene::edge_cross;
use crate::trace::Hit;

impl RayCaster<'_> {
    /// Returns the irradiance at `origin`, above a surface with this shading and this geometric normal, from a surface
    /// that a ray of a punctual light hits. `path_density` is the density of the other strategy, which accounts for the
    /// rest of the light.
    pub(crate) fn connected_irradiance(
        &self,
        origin: Vec3,
        normal: Vec3,
        geometric: Vec3,
        path_density: impl Fn(Vec3) -> f32,
        sampler: &mut Sampler,
    ) -> Vec3 {
        let Some((light, beam)) = self.beams.ray(sampler) else { return Vec3::ZERO };
        let Some(lit) = self.meet(&beam, sampler) else { return Vec3::ZERO };
        let corners = self.scene().corners(lit.triangle);
        let offset = interpolate(corners, lit.barycentric) - origin;
        let distance = offset.length();
        let direction = offset / distance.max(f32::MIN_POSITIVE);
        let is_front = edge_cross(corners).dot(direction) < 0.0;
        // The light and the point must be on the same side.
        if normal.dot(direction) <= 0.0 || geometric.dot(direction) <= 0.0 || is_front != lit.is_front {
            return Vec3::ZERO;
        }
        let density = path_density(direction);
        let ray = Ray { origin, direction, source: RaySource::Diffuse { normal, density } };
        let surface = Surface::at(self.scene(), &ray, &Hit { distance, is_front, ..lit }, self.has_specular);
        let lit_point = self.above(surface.position, surface.geometric);
        let arrival = self.scene().lights[light].arrival(lit_point);
        let radiance = self.unoccluded(&surface, &arrival);
        if radiance == Vec3::ZERO {
            return Vec3::ZERO;
        }
        let passing = self.passing(origin, lit_point - origin, 1.0);
        if passing.has_pane {
            return Vec3::ZERO;
        }
        let ours = self.beams.density(light, &arrival, &surface, distance);
        let theirs = density * self.lights.punctual_probability(light, lit_point, surface.normal);
        radiance * passing.share * (normal.dot(direction) * power_heuristic(ours, theirs) / ours)
    }
}
