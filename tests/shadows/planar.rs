//! Planar shadows: correct on their receivers, and with each fault of the textbook if its cure is off.

use glam::Vec3;
use hemicube::render::{ShadowSettings, ShadowTechnique};
use hemicube::scene::LightKind;

use super::stage::{Stage, at, settings};
use crate::support::device::gpu;

#[test]
fn case_21_planar_shadows_show_each_fault_if_its_cure_is_off() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::new();
    // A box through the floor, one above another, one whose shadow reaches beyond the floor, and one below the floor.
    stage.cube(at(-1.5, 0.2, 0.0), 0).cube(at(0.5, 1.0, 0.0), 0).cube(at(0.6, 2.2, 0.1), 0).cube(at(3.4, 0.9, 0.0), 0);
    stage.cube(at(1.0, -1.5, 2.5), 0);
    // A lower floor beyond the edge of the upper one.
    stage.quad(Vec3::new(4.0, -1.5, 4.0), 6.0 * Vec3::X, -8.0 * Vec3::Z);
    stage.seen(Vec3::new(2.5, 4.0, 7.0), Vec3::new(2.5, 0.0, 0.0));
    let shot = stage.shot(gpu);
    let mut planar = settings(ShadowTechnique::Planar);
    planar.planar.num_receivers = 1;
    assert_eq!(shot.fault(gpu, &planar), 0.0, "right on its receiver");
    let with = |change: fn(&mut ShadowSettings)| {
        let mut faulty = planar.clone();
        change(&mut faulty);
        faulty
    };
    let right = shot.picture(gpu, &planar, 1);
    let changed = |faulty: &ShadowSettings| {
        let picture = shot.picture(gpu, faulty, 1);
        let pairs = picture.radiance.iter().zip(&right.radiance);
        pairs.filter(|(a, b)| (a[0] - b[0]).abs() > 0.01).count()
    };
    let sticking_out = changed(&with(|s| s.planar.stays_on_receiver = false));
    let fighting = changed(&with(|s| s.planar.is_free_of_depth = false));
    let twice = changed(&with(|s| s.planar.darkens_once = false));
    let below = changed(&with(|s| s.planar.clips_casters = false));
    assert!(sticking_out > 50, "sticking out: {sticking_out}");
    assert!(fighting > 50, "fighting for depth: {fighting}");
    assert!(twice > 50, "darkened twice: {twice}");
    assert!(below > 50, "thrown from below: {below}");
}

#[test]
fn case_21_a_light_under_the_plane_throws_no_planar_shadow() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::new();
    stage.cube(at(0.0, 1.0, 0.0), 0).light(LightKind::Point { position: Vec3::new(0.3, -3.0, 0.2) });
    assert_eq!(stage.shot(gpu).fault(gpu, &settings(ShadowTechnique::Planar)), 0.0);
}
