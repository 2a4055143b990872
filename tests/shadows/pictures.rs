//! Whole pictures: multisampling, and a snapshot of each technique.

use glam::{Mat4, Quat, Vec3};
use hemicube::render::ShadowTechnique;

use super::stage::{Stage, at, settings};
use crate::support::device::gpu;
use crate::support::snapshot::assert_snapshot;

#[test]
fn case_23_several_samples_a_pixel_change_edges_only() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.2, 0.0), 0);
    let shot = stage.shot(gpu);
    for technique in [ShadowTechnique::VolumeDepthFail, ShadowTechnique::VolumeDepthPass, ShadowTechnique::Planar] {
        let [one, four] = [1, 4].map(|samples| shot.picture(gpu, &settings(technique), samples));
        let pairs = one.radiance.iter().zip(&four.radiance);
        let differing = pairs.filter(|(a, b)| (a[0] - b[0]).abs() > 0.01 * a[0].max(0.1)).count();
        assert!(differing < one.radiance.len() / 20, "{technique:?}: {differing}");
    }
}

#[test]
fn each_technique_looks_like_its_snapshot() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::new();
    stage
        .cube(at(-0.9, 0.9, 0.0) * Mat4::from_quat(Quat::from_rotation_y(0.5)), 0)
        .sphere(Vec3::new(1.1, 1.0, 0.2), 0.7);
    let shot = stage.shot(gpu);
    let techniques = [
        (ShadowTechnique::None, "shadows_none"),
        (ShadowTechnique::Map, "shadows_map"),
        (ShadowTechnique::VolumeDepthPass, "shadows_volume_depth_pass"),
        (ShadowTechnique::VolumeDepthFail, "shadows_volume_depth_fail"),
        (ShadowTechnique::Planar, "shadows_planar"),
        (ShadowTechnique::Raytraced, "shadows_raytraced"),
    ];
    for (technique, name) in techniques {
        assert_snapshot(name, &shot.picture(gpu, &settings(technique), 1));
    }
}
