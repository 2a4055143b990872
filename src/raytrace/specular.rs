//! Mirrors, glossy metal and clear glass: what the second pass adds to diffuse light.
//!
//! Sources: Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces" (GGX); Heitz 2014,
//! "Understanding the Masking-Shadowing Function", and 2018, "Sampling the GGX Distribution of Visible Normals"; Schlick 1994 (Fresnel of metals); KHR_materials_transmission (glass is a thin
//! pane: light goes straight on, tinted by the base colour).

use std::f32::consts::{FRAC_1_PI, TAU};

use glam::{Vec2, Vec3};

use super::sampler::Sampler;
use crate::base::colour::luminance;
use crate::base::sampling::tangent_frame;
use crate::scene::{Material, SurfacePoint};

/// Width of the microfacets' slopes below which metal is a perfect mirror.
const MIRROR_ALPHA: f32 = 1e-3;

/// The part of a surface that is not diffuse.
#[derive(Clone, Debug)]
pub(super) struct Specular {
    /// Shading normal.
    normal: Vec3,
    kind: Kind,
}

/// Where light comes from that a mirror or a pane sends towards the viewer.
pub(super) struct SpecularWay {
    /// Unit vector towards where it comes from.
    pub direction: Vec3,
    /// What the radiance that comes from there is multiplied with.
    pub share: Vec3,
    /// It comes straight through a pane.
    pub is_straight: bool,
}

#[derive(Clone, Debug)]
enum Kind {
    /// Reflectance head-on, and the width of the slopes of its facets.
    Metal { facing: Vec3, alpha: f32 },
    /// Index of refraction; share of the surface that is clear, per channel and in all.
    Pane { ior: f32, tint: Vec3, share: f32 },
}

impl Specular {
    /// Metal or glass at a point of `material`, if it is any.
    pub(super) fn of(point: &SurfacePoint, material: &Material, normal: Vec3) -> Option<Self> {
        let kind = if material.transmission > 0.0 {
            Kind::Pane { ior: material.ior, tint: point.base_colour.min(Vec3::ONE), share: material.transmission }
        } else if point.metal != Vec3::ZERO {
            Kind::Metal { facing: point.metal, alpha: point.roughness * point.roughness }
        } else {
            return None;
        };
        Some(Self { normal, kind })
    }

    /// It sends light on in one direction only.
    pub(super) fn is_perfect(&self) -> bool {
        !matches!(self.kind, Kind::Metal { alpha, .. } if alpha >= MIRROR_ALPHA)
    }

    /// Share of the surface that is clear and therefore not diffuse.
    pub(super) fn clear_share(&self) -> f32 {
        match self.kind {
            Kind::Pane { share, .. } => share,
            Kind::Metal { .. } => 0.0,
        }
    }

    /// About how much light is sent on towards the viewer.
    pub(super) fn weight(&self, to_viewer: Vec3) -> f32 {
        match self.kind {
            Kind::Metal { facing, .. } => luminance(schlick(facing, self.normal.dot(to_viewer))),
            Kind::Pane { share, .. } => share,
        }
    }

    /// Share of light that a pane lets pass straight on; none where it is no pane.
    pub(super) fn passing(&self, to_viewer: Vec3) -> Option<Vec3> {
        match self.kind {
            Kind::Pane { ior, tint, share } => Some(tint * (share * (1.0 - fresnel(self.normal.dot(to_viewer), ior)))),
            Kind::Metal { .. } => None,
        }
    }

    /// A way on, chosen by chance; `geometric` is the geometric normal on the viewer's side.
    pub(super) fn scatter(&self, to_viewer: Vec3, geometric: Vec3, sampler: &mut Sampler) -> Option<SpecularWay> {
        let reflected = |direction, share| SpecularWay { direction, share, is_straight: false };
        match self.kind {
            Kind::Pane { ior, tint, share } => {
                let is_reflected = sampler.number() < fresnel(self.normal.dot(to_viewer), ior);
                Some(if is_reflected {
                    reflected(self.mirrored(to_viewer, geometric), Vec3::splat(share))
                } else {
                    SpecularWay { direction: -to_viewer, share: tint * share, is_straight: true }
                })
            }
            Kind::Metal { facing, alpha } if alpha < MIRROR_ALPHA => {
                Some(reflected(self.mirrored(to_viewer, geometric), schlick(facing, self.normal.dot(to_viewer))))
            }
            Kind::Metal { facing, alpha } => {
                let facet = visible_facet(to_viewer, self.normal, alpha, sampler.square());
                let direction = reflect(to_viewer, facet);
                let cosine = direction.dot(self.normal);
                let is_outside = direction.dot(geometric) > 0.0 && cosine > 0.0;
                // The viewer sees the facet; others may hide the way on.
                let seen = 1.0 + hidden(to_viewer.dot(self.normal), alpha);
                let open = seen / (seen + hidden(cosine, alpha));
                is_outside.then(|| reflected(direction, schlick(facing, facet.dot(to_viewer)) * open))
            }
        }
    }

    /// Mirror image in the smooth normal; in the geometric one where that would lead below the surface.
    fn mirrored(&self, to_viewer: Vec3, geometric: Vec3) -> Vec3 {
        let direction = reflect(to_viewer, self.normal);
        if direction.dot(geometric) > 0.0 { direction } else { reflect(to_viewer, geometric) }
    }

    /// Density per steradian with which [`Self::scatter`] takes a direction; 0 of a mirror or a pane.
    pub(super) fn density(&self, to_viewer: Vec3, direction: Vec3) -> f32 {
        let (cos_out, cos_in) = (self.normal.dot(to_viewer), self.normal.dot(direction));
        match self.kind {
            Kind::Metal { alpha, .. } if alpha >= MIRROR_ALPHA && cos_in > 0.0 && cos_out > 0.0 => {
                let facet = (to_viewer + direction).normalize();
                facet_density(self.normal.dot(facet), alpha) / ((1.0 + hidden(cos_out, alpha)) * 4.0 * cos_out)
            }
            _ => 0.0,
        }
    }

    /// Radiance towards the viewer under unit irradiance on a surface across `to_light`, times the cosine: the highlight
    /// of a light that is aimed at. None of a mirror's or a pane's.
    pub(super) fn highlight(&self, to_viewer: Vec3, to_light: Vec3) -> Vec3 {
        let (cos_out, cos_in) = (self.normal.dot(to_viewer), self.normal.dot(to_light));
        match self.kind {
            Kind::Metal { facing, alpha } if alpha >= MIRROR_ALPHA && cos_in > 0.0 && cos_out > 0.0 => {
                let facet = (to_viewer + to_light).normalize();
                let density = facet_density(self.normal.dot(facet), alpha);
                let open = 1.0 / (1.0 + hidden(cos_in, alpha) + hidden(cos_out, alpha));
                schlick(facing, facet.dot(to_viewer)) * (density * open / (4.0 * cos_out))
            }
            _ => Vec3::ZERO,
        }
    }
}

/// Mirror image of a direction away from the surface.
fn reflect(away: Vec3, normal: Vec3) -> Vec3 {
    2.0 * away.dot(normal) * normal - away
}

/// Reflectance of metal under an angle.
fn schlick(facing: Vec3, cosine: f32) -> Vec3 {
    facing + (1.0 - facing) * (1.0 - cosine.clamp(0.0, 1.0)).powi(5)
}

/// Reflectance of one boundary of a dielectric.
fn fresnel(cosine: f32, ior: f32) -> f32 {
    let cos_in = cosine.clamp(0.0, 1.0);
    let cos_out_squared = 1.0 - (1.0 - cos_in * cos_in) / (ior * ior);
    if cos_out_squared <= 0.0 {
        return 1.0;
    }
    let cos_out = cos_out_squared.sqrt();
    let across = (cos_in - ior * cos_out) / (cos_in + ior * cos_out);
    let along = (ior * cos_in - cos_out) / (ior * cos_in + cos_out);
    0.5 * (across * across + along * along)
}

/// GGX density of facets by the cosine to the surface normal.
fn facet_density(cosine: f32, alpha: f32) -> f32 {
    let squared = alpha * alpha;
    let spread = cosine * cosine * (squared - 1.0) + 1.0;
    squared * FRAC_1_PI / (spread * spread)
}

/// GGX facets that others hide in a direction, per facet that is seen (Smith's function; Heitz 2014, eq. 72).
fn hidden(cosine: f32, alpha: f32) -> f32 {
    let tan_squared = 1.0 / (cosine * cosine).max(1e-12) - 1.0;
    0.5 * ((1.0 + alpha * alpha * tan_squared).sqrt() - 1.0)
}

/// Normal of a facet, drawn from those that the viewer sees.
fn visible_facet(to_viewer: Vec3, normal: Vec3, alpha: f32, square: Vec2) -> Vec3 {
    let (tangent, bitangent) = tangent_frame(normal);
    let local = Vec3::new(to_viewer.dot(tangent), to_viewer.dot(bitangent), to_viewer.dot(normal).max(1e-6));
    // Facets of a sphere, stretched to the slopes: a point of the disc that the viewer sees of the upper half.
    let viewer = (local * Vec3::new(alpha, alpha, 1.0)).normalize();
    let radius = square.x.sqrt();
    let (sin, cos) = (TAU * square.y).sin_cos();
    // The horizon cuts the disc across the direction of the surface normal in it.
    let towards = (Vec3::Z - viewer * viewer.z).normalize_or(tangent_frame(viewer).0);
    let across = towards.cross(viewer);
    let x = radius * cos;
    let blend = 0.5 * (1.0 + viewer.z);
    let y = (1.0 - blend) * (1.0 - x * x).max(0.0).sqrt() + blend * radius * sin;
    let on_sphere = across * x + towards * y + viewer * (1.0 - x * x - y * y).max(0.0).sqrt();
    let facet = Vec3::new(alpha * on_sphere.x, alpha * on_sphere.y, on_sphere.z.max(1e-6)).normalize();
    tangent * facet.x + bitangent * facet.y + normal * facet.z
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::sampling::{cosine_hemisphere, r2};

    fn metal(alpha: f32) -> Specular {
        Specular { normal: Vec3::Z, kind: Kind::Metal { facing: Vec3::new(1.0, 0.6, 0.2), alpha } }
    }

    #[test]
    fn followed_rays_and_highlights_reflect_as_much() {
        const COUNT: u32 = 1 << 16;
        // Share of all light, by numerical integration of the formulas in another program.
        let views =
            [(0.3, Vec3::new(0.6, 0.0, 0.8), 0.858), (0.8, Vec3::new(0.0, -0.8, 0.6), 0.508), (0.5, Vec3::Z, 0.688)];
        for (alpha, to_viewer, share) in views {
            let metal = metal(alpha);
            let followed = |index| {
                let mut sampler = Sampler::new(3, index);
                metal.scatter(to_viewer, Vec3::Z, &mut sampler).map_or(Vec3::ZERO, |way| way.share)
            };
            let followed = (0..COUNT).map(followed).sum::<Vec3>() / COUNT as f32;
            let lit = |index| {
                let to_light = cosine_hemisphere(Vec3::Z, r2(index, 1));
                metal.highlight(to_viewer, to_light) / (to_light.z.max(1e-6) * FRAC_1_PI)
            };
            let lit = (0..COUNT).map(lit).sum::<Vec3>() / COUNT as f32;
            assert!((followed / lit - 1.0).abs().max_element() < 0.02, "{alpha}: {followed} and {lit}");
            assert!((followed.x - share).abs() < 5e-3, "{alpha}: {followed}");
        }
    }

    #[test]
    fn directions_are_as_dense_as_stated() {
        const COUNT: u32 = 1 << 16;
        for (alpha, to_viewer) in [(0.3, Vec3::new(0.6, 0.0, 0.8)), (0.8, Vec3::new(0.0, -0.8, 0.6)), (0.1, Vec3::Z)] {
            let metal = metal(alpha);
            // A share of all directions and a mean cosine, counted and integrated.
            let way = |index| metal.scatter(to_viewer, Vec3::Z, &mut Sampler::new(3, index));
            let ways = (0..COUNT).filter_map(way).map(|way| Vec3::new(1.0, way.direction.x, way.direction.z));
            let counted = ways.sum::<Vec3>() / COUNT as f32;
            let integrand = |index| {
                let direction = cosine_hemisphere(Vec3::Z, r2(index, 1));
                let density = metal.density(to_viewer, direction) / (direction.z.max(1e-6) * FRAC_1_PI);
                density * Vec3::new(1.0, direction.x, direction.z)
            };
            let integrated = (0..COUNT).map(integrand).sum::<Vec3>() / COUNT as f32;
            assert!((counted - integrated).abs().max_element() < 0.01, "{alpha}: {counted} and {integrated}");
        }
    }

    #[test]
    fn glass_reflects_four_percent_head_on_and_all_at_grazing_angles() {
        assert!((fresnel(1.0, 1.5) - 0.04).abs() < 1e-6);
        assert!(fresnel(1e-4, 1.5) > 0.99);
        assert_eq!(fresnel(0.7, 1.0), 0.0);
    }
}
