//! The surface at a ray's hit, and how it scatters light.

use std::f32::consts::FRAC_1_PI;

use glam::Vec3;

use crate::base::colour::luminance;
use crate::base::ids::TriangleId;
use crate::base::sampling::cosine_hemisphere;
use crate::base::triangle::interpolate;
use crate::raytrace::ray::{Ray, RaySource};
use crate::raytrace::sampler::Sampler;
use crate::raytrace::surface::normal_map::mapped_normal;
use crate::raytrace::surface::specular::{Specular, SpecularWay};
use crate::scene::{Scene, edge_cross};
use crate::trace::Hit;

/// A point of a surface that a ray has hit, seen from the side of the ray.
#[derive(Clone, Debug)]
pub(crate) struct Surface {
    pub triangle: TriangleId,
    /// Weights of the triangle's corners.
    pub barycentric: Vec3,
    /// True if the ray comes from the front.
    pub is_front: bool,
    pub position: Vec3,
    /// Geometric unit normal on the ray's side.
    pub geometric: Vec3,
    /// Unit normal of the cosine of diffuse reflection: the interpolated one if the camera sees the surface, directly
    /// or in a mirror; the geometric one after a diffuse reflection, as in radiosity.
    pub normal: Vec3,
    /// Unit vector towards the origin of the ray.
    pub to_viewer: Vec3,
    /// Diffuse reflectance; 0 on the back of a single-sided surface.
    pub reflectance: Vec3,
    /// Diffuse reflectance of the share that is clear glass. Radiosity uses it, because it treats glass as paint.
    pub unclear_reflectance: Vec3,
    /// Emitted radiance; 0 on the back of a single-sided surface.
    pub emission: Vec3,
    /// The part that is metal or glass. `None` if there is none.
    pub specular: Option<Specular>,
}

/// A direction that a path takes from a surface.
pub(crate) struct Scattered {
    pub direction: Vec3,
    /// Factor of the radiance from that direction.
    pub throughput: Vec3,
    pub way: Way,
}

/// The kind of scattering.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Way {
    /// Diffuse reflection, with the density of the direction per steradian. Lamps are sampled as well.
    Diffuse { density: f32 },
    /// Reflection in a mirror, in glossy metal or at a pane. The density of the direction is per steradian, or 0 if
    /// only one direction is possible.
    Reflected { density: f32 },
    /// Straight through a pane.
    Passed,
}

impl Surface {
    /// Returns the surface that `ray` has hit at `hit`. Without `has_specular`, metals absorb and glass is opaque, as
    /// in radiosity.
    pub(crate) fn at(scene: &Scene, ray: &Ray, hit: &Hit, has_specular: bool) -> Self {
        let corners = scene.corners(hit.triangle);
        let weights = hit.barycentric;
        let front = edge_cross(corners).normalize_or_zero();
        let material = scene.material_of(hit.triangle);
        let geometric = if hit.is_front { front } else { -front };
        let mut surface = Self {
            triangle: hit.triangle,
            barycentric: weights,
            is_front: hit.is_front,
            position: interpolate(corners, weights),
            geometric,
            normal: geometric,
            to_viewer: -ray.direction,
            reflectance: Vec3::ZERO,
            unclear_reflectance: Vec3::ZERO,
            emission: Vec3::ZERO,
            specular: None,
        };
        let has_side = hit.is_front || material.double_sided;
        // A pane is clear from both sides, whether or not its material is double-sided.
        if has_side || has_specular && material.transmission > 0.0 {
            let point = scene.surface_at(hit.triangle, weights);
            if has_side {
                surface.emission = point.emission;
                surface.reflectance = point.reflectance;
            }
            let shading = surface.shading_normal(scene, has_specular);
            if !matches!(ray.source, RaySource::Diffuse { .. } | RaySource::BehindPane) {
                surface.normal = shading;
            }
            if has_specular && !material.unlit {
                surface.specular = Specular::of(&point, material, shading);
                let clear_share = surface.specular.as_ref().map_or(0.0, Specular::clear_share);
                surface.unclear_reflectance = surface.reflectance * clear_share;
                surface.reflectance -= surface.unclear_reflectance;
            }
        }
        surface
    }

    /// Returns the interpolated unit normal on the side of the ray, perturbed by the normal map if `is_mapped`. If it
    /// faces away from the ray, returns the geometric normal instead.
    fn shading_normal(&self, scene: &Scene, is_mapped: bool) -> Vec3 {
        let normals = scene.triangles[self.triangle.index()].vertices.map(|v| scene.vertices[v as usize].normal);
        let weights = self.barycentric;
        let smooth = interpolate(normals, weights).normalize_or_zero();
        let smooth = if smooth.dot(self.geometric) < 0.0 { -smooth } else { smooth };
        let side = if self.is_front { 1.0 } else { -1.0 };
        let mapped = is_mapped.then(|| mapped_normal(scene, self.triangle, weights, side * smooth)).flatten();
        let shading = mapped.map_or(smooth, |mapped| side * mapped);
        if shading.dot(self.to_viewer) > 0.0 { shading } else { self.geometric }
    }

    /// Density per steradian with which [`Self::scatter`] reflects diffusely into a direction.
    pub(crate) fn diffuse_density(&self, direction: Vec3) -> f32 {
        self.diffuse_share() * self.normal.dot(direction).max(0.0) * FRAC_1_PI
    }

    /// Density per steradian with which the metal of the surface reflects into a direction; 0 for a perfect mirror.
    pub(crate) fn glossy_density(&self, direction: Vec3) -> f32 {
        self.specular.as_ref().map_or(0.0, |specular| specular.density(self.to_viewer, direction))
    }

    /// Density per steradian with which [`Self::scatter`] reflects in metal into a direction; 0 for a perfect mirror.
    pub(crate) fn scattered_glossy_density(&self, direction: Vec3) -> f32 {
        self.glossy_density(direction) * (1.0 - self.diffuse_share())
    }

    /// Chooses a direction at random. Returns `None` if the light is absorbed.
    pub(crate) fn scatter(&self, sampler: &mut Sampler) -> Option<Scattered> {
        let diffuse_share = self.diffuse_share();
        let is_diffuse = match &self.specular {
            None if diffuse_share == 0.0 => return None,
            None => true,
            Some(_) => sampler.number() < diffuse_share,
        };
        if is_diffuse {
            let direction = cosine_hemisphere(self.normal, sampler.square());
            let is_outside = direction.dot(self.geometric) > 0.0;
            return is_outside.then(|| Scattered {
                direction,
                throughput: self.reflectance / diffuse_share,
                way: Way::Diffuse { density: self.diffuse_density(direction) },
            });
        }
        let specular = self.specular.as_ref()?;
        let SpecularWay { direction, share, is_straight } =
            specular.scatter(self.to_viewer, self.geometric, sampler)?;
        let density = self.glossy_density(direction) * (1.0 - diffuse_share);
        let way = if is_straight { Way::Passed } else { Way::Reflected { density } };
        Some(Scattered { direction, throughput: share / (1.0 - diffuse_share), way })
    }

    /// Probability with which [`Self::scatter`] reflects diffusely.
    fn diffuse_share(&self) -> f32 {
        let diffuse = luminance(self.reflectance);
        match &self.specular {
            _ if diffuse <= 0.0 => 0.0,
            None => 1.0,
            Some(specular) => diffuse / (diffuse + specular.weight(self.to_viewer)),
        }
    }
}
