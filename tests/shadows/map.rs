//! Shadow maps against rays.

use glam::Vec3;
use hemicube::render::ShadowTechnique;
use hemicube::scene::LightKind;

use super::stage::{Stage, at, settings};
use crate::support::device::gpu;

#[test]
fn case_22_maps_are_right_within_their_resolution_and_show_acne_without_bias() {
    let Some(gpu) = gpu() else { return };
    let kinds = [
        LightKind::Point { position: Vec3::new(0.7, 4.0, 0.4) },
        LightKind::Directional { direction: Vec3::new(0.3, -1.0, -0.4).normalize() },
        LightKind::Spot {
            position: Vec3::new(0.7, 4.0, 0.4),
            direction: Vec3::NEG_Y,
            inner_angle: 0.6,
            outer_angle: 0.8,
        },
    ];
    for kind in kinds {
        let mut stage = Stage::new();
        stage.cube(at(0.0, 1.0, 0.0), 0).sphere(Vec3::new(-1.6, 1.0, 0.3), 0.6).light(kind);
        let shot = stage.shot(gpu);
        let mut map = settings(ShadowTechnique::Map);
        map.maps.resolution = 1024;
        let share = shot.fault(gpu, &map);
        assert!(share <= 0.005, "{kind:?}: {share}");
        (map.maps.normal_offset, map.maps.slope_bias, map.maps.pcf_radius) = (0.0, 0.0, 0);
        let with_acne = shot.fault(gpu, &map);
        assert!(with_acne > 0.003 && with_acne > 4.0 * share, "{kind:?}: {with_acne} without bias, {share} with");
    }
}
