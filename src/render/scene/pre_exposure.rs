//! Pre-exposure: the power of two that brings a scene's radiance into the range of half floats.
//!
//! HDR pictures are stored as half floats, which hold 6e-8 to 65,504, and a scene in real units ranges from moonlight
//! to the sun. Every radiance is multiplied by the pre-exposure before it is stored, and the tone map divides by it
//! again (Lagarde and de Rousiers 2014, "Moving Frostbite to Physically Based Rendering"). A power of two loses no
//! precision.

use crate::baked::{BakedScene, VertexLight};

/// Largest radiance of a lamp after scaling. Half floats hold four times as much.
const COMFORTABLE_RADIANCE: f32 = 16_384.0;
/// Range of the typical radiance of surfaces after scaling. Half floats hold light a thousand times as strong or as
/// weak.
const COMFORTABLE_SURFACES: std::ops::RangeInclusive<f32> = 1.0 / 1024.0..=64.0;

/// Returns a power of two that brings the brightest lamp below [`COMFORTABLE_RADIANCE`] but keeps lit surfaces within
/// [`COMFORTABLE_SURFACES`]; 1 if both hold already.
pub(super) fn pre_exposure(baked: &BakedScene) -> f32 {
    let lamps = baked.scene.materials.iter().map(|material| material.emission.max_element());
    let for_lamps = (COMFORTABLE_RADIANCE / lamps.fold(0.0, f32::max)).min(1.0);
    let typical = typical_white_radiance(&baked.light);
    let (low, high) = (COMFORTABLE_SURFACES.start() / typical, COMFORTABLE_SURFACES.end() / typical);
    let scale = if typical.is_normal() { for_lamps.clamp(low, high) } else { for_lamps };
    scale.log2().floor().exp2()
}

/// Returns the log-average of E / pi, the radiance of white paint. Each vertex counts once for the direct and once for
/// the indirect irradiance E of each light group.
///
/// The logarithm limits the influence of single vertices: the irradiance of a vertex that touches a point light is
/// unbounded.
fn typical_white_radiance(light: &VertexLight) -> f32 {
    let values = light.groups.iter().flat_map(|group| group.direct.iter().chain(&group.indirect));
    let radiances = values.map(|value| value.max_element() / std::f32::consts::PI);
    let (mut log_sum, mut count) = (0.0, 0u32);
    for radiance in radiances.filter(|radiance| radiance.is_finite() && *radiance > 0.0) {
        log_sum += f64::from(radiance.log2());
        count += 1;
    }
    if count == 0 { 0.0 } else { (log_sum / f64::from(count)).exp2() as f32 }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::scene::{Material, Scene};

    #[test]
    fn only_very_bright_scenes_are_scaled_down_and_by_a_power_of_two() {
        let lamp = |nit| {
            let material = Material { emission: Vec3::splat(nit), ..Material::default() };
            BakedScene { scene: Scene { materials: vec![material], ..Scene::default() }, ..BakedScene::default() }
        };
        assert_eq!(pre_exposure(&lamp(0.0)), 1.0);
        assert_eq!(pre_exposure(&lamp(10_000.0)), 1.0);
        assert_eq!(pre_exposure(&lamp(1.6e9)), 2f32.powi(-17));
    }

    #[test]
    fn one_unbounded_vertex_does_not_darken_the_scene() {
        let scale_of = |strongest: f32| {
            let mut light = VertexLight::dark(1, 1000);
            light.groups[0].direct.fill(Vec3::ONE);
            light.groups[0].direct[7] = Vec3::splat(strongest);
            pre_exposure(&BakedScene { light, ..BakedScene::default() })
        };
        assert_eq!(scale_of(f32::INFINITY), 1.0);
        assert_eq!(scale_of(f32::NAN), 1.0);
        assert_eq!(scale_of(1e9), 1.0);
    }
}
