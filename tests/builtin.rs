//! The built-in scenes seen by rays: rooms without leaks.

use glam::Vec3;
use hemicube::base::sampling::r2;
use hemicube::scene::{LightKind, Scene, builtin};
use hemicube::trace::Tracer;

/// The `index`-th of many directions, all equally likely.
fn direction(index: u32) -> Vec3 {
    let at = r2(index, 3);
    let y = 1.0 - 2.0 * at.x;
    let (sin, cos) = (std::f32::consts::TAU * at.y).sin_cos();
    Vec3::new(cos, 0.0, sin) * (1.0 - y * y).sqrt() + Vec3::Y * y
}

/// Rays from `eye` that end in the void, and those that meet a surface from behind.
fn leaks(scene: &Scene, eye: Vec3) -> (Vec<Vec3>, Vec<Vec3>) {
    let tracer = Tracer::new(scene);
    let (mut void, mut behind) = (Vec::new(), Vec::new());
    for direction in (0..20_000).map(direction) {
        match tracer.nearest(eye, direction, f32::INFINITY) {
            None => void.push(direction),
            Some(hit) if !hit.is_front => behind.push(direction),
            Some(_) => {}
        }
    }
    (void, behind)
}

#[test]
fn from_every_camera_of_the_gallery_only_windows_open_to_the_void() {
    let scene = builtin::gallery();
    for camera in &scene.cameras {
        let (void, behind) = leaks(&scene, camera.position);
        assert!(behind.is_empty(), "{}: backs are seen towards {:?}", camera.name, behind[0]);
        for direction in void {
            assert!(direction.z > 0.3 && direction.y > 0.2, "{}: a leak towards {direction}", camera.name);
        }
    }
}

#[test]
fn the_sun_reaches_the_floor_of_the_hall() {
    let scene = builtin::gallery();
    let tracer = Tracer::new(&scene);
    let direction = scene.lights.iter().find_map(|light| match light.kind {
        LightKind::Directional { direction } => Some(direction),
        _ => None,
    });
    let to_sun = -direction.expect("there is a sun");
    let num_sunlit = (0..10_000)
        .map(|i| r2(i, 5))
        .filter(|at| tracer.transmittance(Vec3::new(at.x * 6.0, 1e-3, at.y * 7.2), to_sun, f32::INFINITY) > 0.0)
        .count();
    // Three windows of 1.2 m x 1.2 m projected on to 6.0 m x 7.2 m of floor; columns and steps take their part.
    let share = num_sunlit as f32 / 10_000.0;
    let windows = 3.0 * 1.2 * 1.2 * (0.975 / 0.8) / (6.0 * 7.2);
    assert!(share > 0.4 * windows && share < windows, "{share} of {windows}");
}
