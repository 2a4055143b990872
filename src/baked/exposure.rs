//! A single exposure for a bake, used for all views.
//!
//! It is determined as in shaders/display/light_meter.wgsl, with surfaces in place of pixels: the mean of the
//! logarithms of luminance is shown as middle grey, unless highlights would be overexposed.

use std::f32::consts::PI;

use glam::Vec3;

use super::BakedScene;
use crate::base::colour::luminance;
use crate::base::ids::TriangleId;
use crate::scene::area_of;

/// Display value of the mean luminance.
const MIDDLE_GREY: f32 = 0.2;
/// Share of the lit area that is darker than the highlights.
const HIGHLIGHT_SHARE: f32 = 0.95;
/// Largest display value of a highlight, where tone mapping begins to compress.
const HIGHLIGHT: f32 = 0.8;
/// Surfaces darker than this share of the brightest one do not count.
const DARK: f32 = 1e-4;

/// Returns the exposure value EV: displayed = radiance x 2^EV; 0 if nothing is lit.
///
/// Textures count as white.
#[must_use]
pub fn suited(baked: &BakedScene) -> f32 {
    let mut lit: Vec<(f32, f32)> = (0..baked.scene.triangles.len()).map(|t| luminance_and_area(baked, t)).collect();
    let brightest = lit.iter().map(|&(luminance, _)| luminance).fold(0.0, f32::max);
    lit.retain(|&(luminance, area)| luminance > DARK * brightest && area > 0.0);
    let total: f32 = lit.iter().map(|&(_, area)| area).sum();
    if lit.is_empty() || total <= 0.0 {
        return 0.0;
    }
    let mean = lit.iter().map(|&(luminance, area)| luminance.log2() * area).sum::<f32>() / total;
    lit.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut below = 0.0;
    let highlight = lit.iter().find(|&&(_, area)| {
        below += area;
        below >= HIGHLIGHT_SHARE * total
    });
    let highlight = highlight.map_or(brightest, |&(luminance, _)| luminance);
    (MIDDLE_GREY.log2() - mean).min((HIGHLIGHT / highlight).log2())
}

/// Returns the reflected luminance at the middle of a triangle, nit, and its area.
fn luminance_and_area(baked: &BakedScene, t: usize) -> (f32, f32) {
    let scene = &baked.scene;
    let triangle = &scene.triangles[t];
    let mean = |of: &dyn Fn(usize) -> Vec3| triangle.vertices.iter().map(|&v| of(v as usize)).sum::<Vec3>() / 3.0;
    let irradiance =
        mean(&|v| baked.light.groups.iter().map(|group| group.direct[v] + group.indirect[v]).sum::<Vec3>());
    let paint = mean(&|v| scene.vertices[v].colour.truncate());
    let material = &scene.materials[triangle.material.index()];
    let radiance = material.base_colour.truncate() * paint * irradiance.max(Vec3::ZERO) / PI;
    (luminance(radiance), area_of(scene.corners(TriangleId::new(t))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::baked::{GroupLight, VertexLight};
    use crate::scene::{Material, SceneBuilder};

    /// Equal white triangles with these luminances.
    fn showing(luminances: &[f32]) -> BakedScene {
        let direct = luminances.iter().flat_map(|&luminance| [Vec3::splat(luminance * PI); 3]).collect::<Vec<_>>();
        let mut builder = SceneBuilder::default();
        let metal = builder.material(Material::default());
        for _ in luminances {
            builder.triangle([Vec3::ZERO, Vec3::X, Vec3::Y], metal);
        }
        let scene = builder.build();
        let indirect = vec![Vec3::ZERO; direct.len()];
        BakedScene::new(scene, VertexLight { groups: vec![GroupLight { direct, indirect }] })
    }

    #[test]
    fn the_mean_is_shown_as_middle_grey() {
        assert!((suited(&showing(&[10.0, 10.0])).exp2() * 10.0 - MIDDLE_GREY).abs() < 1e-4);
        assert!((suited(&showing(&[5.0, 20.0, 0.0])).exp2() * 10.0 - MIDDLE_GREY).abs() < 1e-4);
    }

    #[test]
    fn highlights_are_not_overexposed() {
        let exposure = suited(&showing(&[1.0, 1.0, 1.0, 1000.0])).exp2();
        assert!((exposure * 1000.0 - HIGHLIGHT).abs() < 1e-3, "{exposure}");
    }

    #[test]
    fn a_dark_scene_has_exposure_0() {
        assert_eq!(suited(&showing(&[0.0])), 0.0);
        assert_eq!(suited(&BakedScene::default()), 0.0);
    }
}
