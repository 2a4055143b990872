//! What a ray meets: the place, and how light is sent on from there.

use std::f32::consts::FRAC_1_PI;

use glam::Vec3;

use super::normal_map::mapped_normal;
use super::path::{Chance, Ray};
use super::sampler::Sampler;
use super::specular::{Specular, SpecularWay};
use crate::base::colour::luminance;
use crate::base::ids::TriangleId;
use crate::base::sampling::cosine_hemisphere;
use crate::base::triangle::interpolate;
use crate::scene::{Scene, edge_cross};
use crate::trace::Hit;

/// A place that a ray has met, seen from the ray's side.
#[derive(Clone, Debug)]
pub(super) struct Surface {
    pub triangle: TriangleId,
    /// Weights of the triangle's corners.
    pub barycentric: Vec3,
    /// The ray came from the front.
    pub is_front: bool,
    pub position: Vec3,
    /// Geometric unit normal on the ray's side.
    pub geometric: Vec3,
    /// Unit normal that diffuse reflection takes its cosine to: the smooth one of what the eye sees, else the geometric.
    pub normal: Vec3,
    /// Unit vector back along the ray.
    pub to_viewer: Vec3,
    /// Diffuse reflectance; 0 on the back of a single-sided surface.
    pub reflectance: Vec3,
    /// Reflectance that radiosity gives it for opaque paint where it is clear glass.
    pub unclear_reflectance: Vec3,
    /// Emitted radiance; 0 on the back of a single-sided surface.
    pub emission: Vec3,
    /// Metal or glass.
    pub specular: Option<Specular>,
}

/// The way on from a surface.
pub(super) struct Scattered {
    pub direction: Vec3,
    /// What the radiance that comes from there is multiplied with.
    pub throughput: Vec3,
    pub way: Way,
}

/// What sends light on.
#[derive(Clone, Copy, Debug)]
pub(super) enum Way {
    /// Diffuse reflection, whose direct light is sampled apart too; density of the direction per steradian.
    Diffuse { density: f32 },
    /// A mirror, glossy metal, or the surface of a pane; density of the direction per steradian, 0 where it is the only one.
    Reflected { density: f32 },
    /// A pane, straight on.
    Passed,
}

impl Surface {
    /// The surface that `ray` has met at `hit`; without `has_specular` it is what radiosity sees: metals absorb and glass is
    /// opaque.
    pub(super) fn at(scene: &Scene, ray: &Ray, hit: &Hit, has_specular: bool) -> Self {
        let [a, b, c] = scene.corners(hit.triangle);
        let weights = hit.barycentric;
        let front = edge_cross([a, b, c]).normalize_or_zero();
        let material = scene.material_of(hit.triangle);
        let geometric = if hit.is_front { front } else { -front };
        let mut surface = Self {
            triangle: hit.triangle,
            barycentric: weights,
            is_front: hit.is_front,
            position: interpolate([a, b, c], weights),
            geometric,
            normal: geometric,
            to_viewer: -ray.direction,
            reflectance: Vec3::ZERO,
            unclear_reflectance: Vec3::ZERO,
            emission: Vec3::ZERO,
            specular: None,
        };
        let has_side = hit.is_front || material.double_sided;
        // A pane is glass from both sides.
        if has_side || has_specular && material.transmission > 0.0 {
            let point = scene.surface_at(hit.triangle, weights);
            if has_side {
                surface.emission = point.emission;
                surface.reflectance = point.reflectance;
            }
            let shading = surface.shading_normal(scene, has_specular);
            if !matches!(ray.chance, Chance::Among { .. } | Chance::Aimed) {
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

    /// Interpolated unit normal on the ray's side, bent by the normal map if `is_mapped`; the geometric one where the ray
    /// would see its back.
    fn shading_normal(&self, scene: &Scene, is_mapped: bool) -> Vec3 {
        let [a, b, c] = scene.triangles[self.triangle.index()].vertices.map(|v| scene.vertices[v as usize].normal);
        let weights = self.barycentric;
        let smooth = interpolate([a, b, c], weights).normalize_or_zero();
        let smooth = if smooth.dot(self.geometric) < 0.0 { -smooth } else { smooth };
        let side = if self.is_front { 1.0 } else { -1.0 };
        let mapped = is_mapped.then(|| mapped_normal(scene, self.triangle, weights, side * smooth)).flatten();
        let shading = mapped.map_or(smooth, |mapped| side * mapped);
        if shading.dot(self.to_viewer) > 0.0 { shading } else { self.geometric }
    }

    /// Density per steradian with which [`Self::scatter`] reflects diffusely into a direction.
    pub(super) fn diffuse_density(&self, direction: Vec3) -> f32 {
        self.diffuse_share() * self.normal.dot(direction).max(0.0) * FRAC_1_PI
    }

    /// Density per steradian with which its metal, where it is followed, reflects into a direction; 0 of a mirror.
    pub(super) fn glossy_density(&self, direction: Vec3) -> f32 {
        self.specular.as_ref().map_or(0.0, |specular| specular.density(self.to_viewer, direction))
    }

    /// As [`Self::diffuse_density`], for [`Self::scatter`]'s reflections in its metal.
    pub(super) fn scattered_glossy_density(&self, direction: Vec3) -> f32 {
        self.glossy_density(direction) * (1.0 - self.diffuse_share())
    }

    /// A way on, or none where all light is absorbed.
    pub(super) fn scatter(&self, sampler: &mut Sampler) -> Option<Scattered> {
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

    /// Probability of a diffuse reflection.
    fn diffuse_share(&self) -> f32 {
        let diffuse = luminance(self.reflectance);
        match &self.specular {
            _ if diffuse <= 0.0 => 0.0,
            None => 1.0,
            Some(specular) => diffuse / (diffuse + specular.weight(self.to_viewer)),
        }
    }
}
