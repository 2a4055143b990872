//! Shadow volumes compared with rays. The numbers are those of known hard cases.

use glam::{Mat4, Quat, Vec3};
use hemicube::render::ShadowTechnique;
use hemicube::render::shadow::shadow_difference;
use hemicube::scene::{AlphaMode, LightKind, Material};

use super::stage::{Stage, at, num_different, paint, raytraced, settings};
use crate::support::device::gpu;
use crate::support::quads::{slot, texture};

#[test]
fn case_01_the_eye_is_inside_a_volume() {
    let mut stage = Stage::new();
    stage.cube(at(0.0, 2.5, 0.0), 0);
    stage.seen(Vec3::new(-0.2, 0.6, 0.1), Vec3::new(4.0, 0.0, 0.6));
    stage.assert_volumes_are_exact();
    let Some(gpu) = gpu() else { return };
    let mut plain = settings(ShadowTechnique::VolumeDepthPass);
    plain.volumes.near_plane_cure = false;
    assert!(stage.shot(gpu).fault(gpu, &plain) > 0.1, "the textbook's fault is visible");
}

#[test]
fn case_02_the_near_plane_cuts_a_volume() {
    let mut stage = Stage::new();
    stage.cube(at(0.0, 2.5, 0.0), 0);
    // A side of the volume passes through the eye.
    let light = Vec3::new(0.7, 4.0, 0.4);
    let edge = Vec3::new(-0.5, 3.0, 0.1);
    let eye = edge + 0.9 * (edge - light);
    stage.seen(eye, Vec3::new(4.0, 0.0, 0.6));
    stage.assert_volumes_are_exact();
}

#[test]
fn case_03_the_caster_is_behind_the_eye() {
    let mut stage = Stage::new();
    stage.cube(at(0.0, 2.0, 3.0), 0).light(LightKind::Point { position: Vec3::new(0.2, 3.5, 5.5) });
    stage.seen(Vec3::new(0.0, 1.5, 2.0), Vec3::new(0.0, 0.0, 0.0));
    stage.assert_volumes_are_exact();
}

#[test]
fn case_04_the_caster_is_between_light_and_eye() {
    let mut stage = Stage::new();
    stage.cube(at(0.3, 2.4, 3.0), 0).light(LightKind::Point { position: Vec3::new(0.4, 4.0, 1.0) });
    stage.seen(Vec3::new(0.2, 1.2, 4.6), Vec3::new(0.0, 0.0, 0.0));
    stage.assert_volumes_are_exact();
}

#[test]
fn case_05_the_light_is_in_a_closed_room() {
    let mut stage = Stage::new();
    // The floor lies within the room.
    stage.cube(at(0.0, 2.0, 0.0) * Mat4::from_scale(Vec3::new(-9.0, 9.0, 9.0)), 0);
    stage.cube(at(-1.0, 0.8, 0.0), 0);
    stage.seen(Vec3::new(0.0, 2.0, 4.2), Vec3::new(-0.5, 0.5, 0.0));
    stage.assert_volumes_are_exact();
}

#[test]
fn case_06_the_light_is_inside_a_caster() {
    let mut stage = Stage::new();
    // The caster is open on one side.
    stage.cube(at(0.7, 4.0, 0.4) * Mat4::from_quat(Quat::from_rotation_z(2.2)), 1);
    stage.assert_volumes_are_exact();
}

#[test]
fn case_07_the_light_is_in_the_plane_of_a_triangle() {
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.0, 0.0), 0).light(LightKind::Point { position: Vec3::new(2.5, 1.5, 0.3) });
    stage.assert_volumes_are_exact();
    stage.light(LightKind::Point { position: Vec3::new(0.5, 4.0, 0.5) });
    stage.assert_volumes_are_exact();
}

#[test]
fn case_08_the_light_is_infinitely_or_very_far() {
    let direction = Vec3::new(0.3, -1.0, -0.4).normalize();
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.5, 0.0), 0).light(LightKind::Directional { direction });
    stage.assert_volumes_are_exact();
    stage.light(LightKind::Point { position: -1e6 * direction });
    stage.scene.lights[0].intensity = Vec3::splat(1e13);
    stage.assert_volumes_are_exact();
}

#[test]
fn case_09_an_open_mesh() {
    for num_open in 1..=4 {
        let mut stage = Stage::new();
        stage.cube(at(0.0, 1.5, 0.0) * Mat4::from_quat(Quat::from_rotation_y(0.5)), num_open);
        stage.assert_volumes_are_exact();
    }
}

#[test]
fn case_10_a_single_quad_with_one_side_or_two() {
    for double_sided in [false, true] {
        let mut stage = Stage::new();
        let material = stage.material(Material { double_sided, ..paint() });
        stage.quad_of(Vec3::new(-0.5, 1.5, 0.5), Vec3::X, Vec3::new(0.0, 0.3, -1.0), material);
        stage.quad_of(Vec3::new(-2.5, 2.0, 0.5), Vec3::new(0.0, 0.3, -1.0), Vec3::X, material);
        stage.assert_volumes_are_exact();
    }
}

#[test]
fn case_11_an_edge_with_three_faces() {
    let mut stage = Stage::new();
    for angle in [0.3f32, 2.0, 4.5] {
        let spoke = Vec3::new(0.0, angle.sin(), angle.cos());
        stage.quad(Vec3::new(-0.7, 1.8, 0.0), 1.4 * Vec3::X, spoke);
    }
    stage.assert_volumes_are_exact();
}

#[test]
fn case_12_faces_turned_over_within_one_mesh() {
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.5, 0.0), 0);
    for triangle in stage.scene.triangles.iter_mut().skip(2).step_by(3) {
        triangle.vertices.swap(1, 2);
    }
    stage.assert_volumes_are_exact();
}

#[test]
fn case_13_and_14_mirrored_and_stretched_instances() {
    let mut stage = Stage::new();
    let turned = Mat4::from_quat(Quat::from_rotation_y(0.7));
    stage.cube(at(-1.0, 1.2, 0.0) * turned * Mat4::from_scale(Vec3::new(-0.5, 1.7, 0.4)), 0);
    stage.cube(at(1.2, 1.5, 0.3) * Mat4::from_scale(Vec3::new(2.0, 0.1, 0.6)) * turned, 0);
    stage.assert_volumes_are_exact();
}

#[test]
fn case_15_triangles_twice_and_without_area() {
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.5, 0.0), 0).cube(at(0.0, 1.5, 0.0), 0);
    stage.triangle([Vec3::new(-2.0, 1.0, 0.0), Vec3::new(-1.0, 1.0, 0.0), Vec3::new(0.0, 1.0, 0.0)], 0);
    stage.triangle([Vec3::ONE; 3], 0);
    stage.assert_volumes_are_exact();
    // Two surfaces in the same place are lit once.
    let Some(gpu) = gpu() else { return };
    let once = |stage: &Stage| stage.shot(gpu).picture(gpu, &settings(ShadowTechnique::None), 1).radiance;
    let mut single = Stage::new();
    single.cube(at(0.0, 1.5, 0.0), 0);
    assert_eq!(once(&stage), once(&single));
}

#[test]
fn case_16_corners_in_the_middle_of_edges() {
    let mut stage = Stage::new();
    // One quad beside seven that share its edge, in a tilted plane with inexact coordinates.
    let (u, v) = (Vec3::new(1.3, 0.17, 0.29), Vec3::new(-0.23, 0.31, -1.1));
    let origin = Vec3::new(-1.0, 1.7, 0.6);
    stage.quad(origin, u, v);
    let near: Vec<Vec3> = (0..=7).map(|i| origin + u + v * (i as f32 / 7.0)).collect();
    let far: Vec<Vec3> = near.iter().map(|&corner| corner + u).collect();
    for i in 0..7 {
        stage.triangle([near[i], far[i], far[i + 1]], 0).triangle([near[i], far[i + 1], near[i + 1]], 0);
    }
    stage.assert_volumes_are_exact();
}

#[test]
fn case_17_more_than_255_volumes_within_each_other() {
    let mut stage = Stage::new();
    for i in 0..300 {
        stage.quad(Vec3::new(-0.6, 1.0 + 0.002 * i as f32, 0.6), 1.2 * Vec3::X, -1.2 * Vec3::Z);
    }
    stage.assert_volumes_are_exact();
}

#[test]
fn case_18_the_empty_background_stays_empty() {
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.5, 0.0), 0).seen(Vec3::new(0.0, 0.5, 7.0), Vec3::new(0.0, 2.5, 0.0));
    stage.assert_volumes_are_exact();
    let Some(gpu) = gpu() else { return };
    let picture = stage.shot(gpu).picture(gpu, &settings(ShadowTechnique::VolumeDepthFail), 1);
    assert!(picture.radiance.iter().filter(|pixel| pixel[3] == 0.0).count() > 1000);
    assert!(picture.radiance.iter().all(|pixel| pixel[3] == 1.0 || pixel == &[0.0; 4]));
}

#[test]
fn case_19_casters_with_holes_and_see_through_ones() {
    let mut stage = Stage::new();
    let holes: Vec<[u8; 4]> = (0..16).map(|i| [255, 255, 255, if (i + i / 4) % 2 == 0 { 255 } else { 0 }]).collect();
    stage.scene.textures.push(texture(4, &holes));
    let base_colour_texture = Some(slot(0));
    let grille =
        stage.material(Material { alpha_mode: AlphaMode::Mask { cutoff: 0.5 }, base_colour_texture, ..paint() });
    let mut glass = paint();
    glass.base_colour.w = 0.3;
    let glass = stage.material(Material { alpha_mode: AlphaMode::Blend, ..glass });
    stage.quad_of(Vec3::new(-1.5, 1.5, 0.7), 1.5 * Vec3::X, -1.5 * Vec3::Z, grille);
    stage.quad_of(Vec3::new(0.8, 1.5, 0.7), Vec3::X, -Vec3::Z, glass);
    stage.assert_volumes_are_exact();
}

#[test]
fn case_20_the_terminator_of_a_smooth_sphere() {
    let mut stage = Stage::new();
    stage.sphere(Vec3::new(0.0, 1.3, 0.0), 1.0);
    stage.assert_volumes_are_exact();
}

#[test]
fn case_25_each_light_has_a_stencil_of_its_own() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.2, 0.0), 0);
    let mut other = stage.scene.lights[0].clone();
    other.kind = LightKind::Point { position: Vec3::new(-3.0, 3.0, 1.0) };
    stage.scene.lights.push(other);
    let shot = stage.shot(gpu);
    let truth = shot.decisions(gpu, &raytraced());
    assert_eq!(truth.samples.len(), 2);
    for technique in [ShadowTechnique::VolumeDepthFail, ShadowTechnique::VolumeDepthPass] {
        let found = shadow_difference(&shot.decisions(gpu, &settings(technique)), &truth);
        assert_eq!(num_different(&found), 0);
    }
    let [a, b] =
        [ShadowTechnique::VolumeDepthFail, ShadowTechnique::Raytraced].map(|t| shot.picture(gpu, &settings(t), 1));
    let differing = a.radiance.iter().zip(&b.radiance).filter(|(a, b)| (a[0] - b[0]).abs() > 0.01).count();
    assert!(differing < 100, "{differing}: edges only");
}

#[test]
fn a_far_plane_cuts_volumes_off_and_the_infinite_projection_does_not() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.5, 0.0), 0);
    let shot = stage.shot(gpu);
    let mut cut = settings(ShadowTechnique::VolumeDepthFail);
    cut.volumes.far_plane = Some(9.0);
    assert!(shot.fault(gpu, &cut) > 0.01);
}
