//! Specular reflection and transmission: mirrors, glossy metal and clear glass.
//!
//! Glossy metal is a surface of microscopic mirrors, whose normals m follow the GGX distribution D. It reflects
//!
//! f(i, o) = F(i m) G(i, o) D(m) / (4 cos_i cos_o), m = (i + o) / |i + o|
//!
//! where F is the Fresnel reflectance (Schlick's approximation) and G the share of facets that are hidden neither from
//! the light nor from the viewer (Smith). D(m) = a^2 / (pi (cos_m^2 (a^2 - 1) + 1)^2) with the width a = roughness^2.
//! A direction is sampled as the reflection in one of the facets that the viewer sees, so its weight is F G / G_viewer.
//! Glass is a thin pane: light passes straight, tinted by the base colour (KHR_materials_transmission), or is reflected
//! by the exact Fresnel equations.
//!
//! Sources: Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces" (GGX); Heitz 2014,
//! "Understanding the Masking-Shadowing Function", and 2018, "Sampling the GGX Distribution of Visible Normals";
//! Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering".

use std::f32::consts::{FRAC_1_PI, TAU};

use glam::{Vec2, Vec3};

use crate::base::colour::luminance;
use crate::base::sampling::tangent_frame;
use crate::raytrace::sampler::Sampler;
use crate::scene::{Material, SurfacePoint};

/// Width a of the GGX distribution below which metal is a perfect mirror.
const MIRROR_ALPHA: f32 = 1e-3;

/// The part of a surface that is not diffuse.
#[derive(Clone, Debug)]
pub(crate) struct Specular {
    /// Shading normal.
    normal: Vec3,
    lobe: Lobe,
}

/// A direction from which a mirror or a pane sends light towards the viewer.
pub(crate) struct SpecularWay {
    /// Unit vector away from the surface.
    pub direction: Vec3,
    /// Factor of the radiance from that direction.
    pub share: Vec3,
    /// True if light comes straight through a pane.
    pub is_straight: bool,
}

/// How specular light is scattered.
#[derive(Clone, Debug)]
enum Lobe {
    /// Reflectance at normal incidence, and the width of the GGX distribution.
    Metal { facing: Vec3, alpha: f32 },
    /// Index of refraction, colour of the glass, and the share of the surface that is clear.
    Pane { ior: f32, tint: Vec3, share: f32 },
}

impl Specular {
    /// Metal or glass at a point of `material`. `None` if there is neither.
    pub(crate) fn of(point: &SurfacePoint, material: &Material, normal: Vec3) -> Option<Self> {
        let lobe = if material.transmission > 0.0 {
            Lobe::Pane { ior: material.ior, tint: point.base_colour.min(Vec3::ONE), share: material.transmission }
        } else if point.metal != Vec3::ZERO {
            Lobe::Metal { facing: point.metal, alpha: point.roughness * point.roughness }
        } else {
            return None;
        };
        Some(Self { normal, lobe })
    }

    /// Returns true if light leaves in one direction only, or in two at a pane.
    pub(crate) fn is_perfect(&self) -> bool {
        !matches!(self.lobe, Lobe::Metal { alpha, .. } if alpha >= MIRROR_ALPHA)
    }

    /// Share of the surface that is clear and therefore not diffuse.
    pub(crate) fn clear_share(&self) -> f32 {
        match self.lobe {
            Lobe::Pane { share, .. } => share,
            Lobe::Metal { .. } => 0.0,
        }
    }

    /// Approximate share of light that is scattered towards the viewer.
    pub(crate) fn weight(&self, to_viewer: Vec3) -> f32 {
        match self.lobe {
            Lobe::Metal { facing, .. } => luminance(schlick(facing, self.normal.dot(to_viewer))),
            Lobe::Pane { share, .. } => share,
        }
    }

    /// Share of light that passes straight through a pane. `None` for metal.
    pub(crate) fn passing(&self, to_viewer: Vec3) -> Option<Vec3> {
        match self.lobe {
            Lobe::Pane { ior, tint, share } => Some(tint * (share * (1.0 - fresnel(self.normal.dot(to_viewer), ior)))),
            Lobe::Metal { .. } => None,
        }
    }

    /// Chooses a direction at random; `geometric` is the geometric normal on the side of the viewer. Returns `None` if
    /// it leads below the surface.
    pub(crate) fn scatter(&self, to_viewer: Vec3, geometric: Vec3, sampler: &mut Sampler) -> Option<SpecularWay> {
        let reflected = |direction, share| SpecularWay { direction, share, is_straight: false };
        match self.lobe {
            Lobe::Pane { ior, tint, share } => {
                let is_reflected = sampler.number() < fresnel(self.normal.dot(to_viewer), ior);
                Some(if is_reflected {
                    reflected(self.mirrored(to_viewer, geometric), Vec3::splat(share))
                } else {
                    SpecularWay { direction: -to_viewer, share: tint * share, is_straight: true }
                })
            }
            Lobe::Metal { facing, alpha } if alpha < MIRROR_ALPHA => {
                Some(reflected(self.mirrored(to_viewer, geometric), schlick(facing, self.normal.dot(to_viewer))))
            }
            Lobe::Metal { facing, alpha } => {
                let facet = visible_facet(to_viewer, self.normal, alpha, sampler.square());
                let direction = reflect(to_viewer, facet);
                let cosine = direction.dot(self.normal);
                let is_outside = direction.dot(geometric) > 0.0 && cosine > 0.0;
                // The viewer sees the facet, but other facets may hide it from the light.
                let seen = 1.0 + hidden(to_viewer.dot(self.normal), alpha);
                let open = seen / (seen + hidden(cosine, alpha));
                is_outside.then(|| reflected(direction, schlick(facing, facet.dot(to_viewer)) * open))
            }
        }
    }

    /// Mirror image about the shading normal, or about the geometric one if the former leads below the surface.
    fn mirrored(&self, to_viewer: Vec3, geometric: Vec3) -> Vec3 {
        let direction = reflect(to_viewer, self.normal);
        if direction.dot(geometric) > 0.0 { direction } else { reflect(to_viewer, geometric) }
    }

    /// Density per steradian with which [`Self::scatter`] chooses a direction; 0 for a mirror or a pane.
    pub(crate) fn density(&self, to_viewer: Vec3, direction: Vec3) -> f32 {
        let (cos_out, cos_in) = (self.normal.dot(to_viewer), self.normal.dot(direction));
        match self.lobe {
            Lobe::Metal { alpha, .. } if alpha >= MIRROR_ALPHA && cos_in > 0.0 && cos_out > 0.0 => {
                let facet = (to_viewer + direction).normalize();
                facet_density(self.normal.dot(facet), alpha) / ((1.0 + hidden(cos_out, alpha)) * 4.0 * cos_out)
            }
            _ => 0.0,
        }
    }

    /// Radiance towards the viewer under unit irradiance on a plane perpendicular to `to_light`: f cos, the highlight
    /// of a light; 0 for a mirror or a pane.
    pub(crate) fn highlight(&self, to_viewer: Vec3, to_light: Vec3) -> Vec3 {
        let (cos_out, cos_in) = (self.normal.dot(to_viewer), self.normal.dot(to_light));
        match self.lobe {
            Lobe::Metal { facing, alpha } if alpha >= MIRROR_ALPHA && cos_in > 0.0 && cos_out > 0.0 => {
                let facet = (to_viewer + to_light).normalize();
                let density = facet_density(self.normal.dot(facet), alpha);
                let open = 1.0 / (1.0 + hidden(cos_in, alpha) + hidden(cos_out, alpha));
                schlick(facing, facet.dot(to_viewer)) * (density * open / (4.0 * cos_out))
            }
            _ => Vec3::ZERO,
        }
    }
}

/// Mirror image about the normal of a direction away from the surface.
fn reflect(away: Vec3, normal: Vec3) -> Vec3 {
    2.0 * away.dot(normal) * normal - away
}

/// Reflectance of metal at an angle by Schlick's approximation: F = F0 + (1 - F0) (1 - cos)^5.
fn schlick(facing: Vec3, cosine: f32) -> Vec3 {
    facing + (1.0 - facing) * (1.0 - cosine.clamp(0.0, 1.0)).powi(5)
}

/// Reflectance of a dielectric boundary for unpolarised light, by the Fresnel equations.
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

/// GGX distribution D of facets by the cosine to the surface normal.
fn facet_density(cosine: f32, alpha: f32) -> f32 {
    let squared = alpha * alpha;
    let spread = cosine * cosine * (squared - 1.0) + 1.0;
    squared * FRAC_1_PI / (spread * spread)
}

/// Smith's Lambda of GGX: facets that others hide from a direction, per visible facet (Heitz 2014, eq. 72). The visible
/// share is G_1 = 1 / (1 + Lambda).
fn hidden(cosine: f32, alpha: f32) -> f32 {
    let tan_squared = 1.0 / (cosine * cosine).max(1e-12) - 1.0;
    0.5 * ((1.0 + alpha * alpha * tan_squared).sqrt() - 1.0)
}

/// Normal of a facet, sampled from those that the viewer sees (Heitz 2018).
fn visible_facet(to_viewer: Vec3, normal: Vec3, alpha: f32, square: Vec2) -> Vec3 {
    let (tangent, bitangent) = tangent_frame(normal);
    let local = Vec3::new(to_viewer.dot(tangent), to_viewer.dot(bitangent), to_viewer.dot(normal).max(1e-6));
    // Stretched by 1 / a, the facets are those of a hemisphere: sample the disc that the viewer sees of it.
    let viewer = (local * Vec3::new(alpha, alpha, 1.0)).normalize();
    let radius = square.x.sqrt();
    let (sin, cos) = (TAU * square.y).sin_cos();
    // The horizon cuts the disc across the direction of the surface normal.
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
        Specular { normal: Vec3::Z, lobe: Lobe::Metal { facing: Vec3::new(1.0, 0.6, 0.2), alpha } }
    }

    #[test]
    fn sampled_directions_and_highlights_reflect_the_same_share() {
        const COUNT: u32 = 1 << 16;
        // Share of all light, by numerical integration of the formulas in an independent program.
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
    fn sampled_directions_have_the_stated_density() {
        const COUNT: u32 = 1 << 16;
        for (alpha, to_viewer) in [(0.3, Vec3::new(0.6, 0.0, 0.8)), (0.8, Vec3::new(0.0, -0.8, 0.6)), (0.1, Vec3::Z)] {
            let metal = metal(alpha);
            // The share of directions above the surface and mean cosines, by counting and by integration.
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
