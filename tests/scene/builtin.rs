//! The built-in scenes are closed: rays find no leaks.

use glam::Vec3;
use hemicube::base::sampling::r2;
use hemicube::scene::{LightKind, Scene, builtin};
use hemicube::trace::Tracer;

/// Returns direction `index` of a sequence that is uniformly distributed over the sphere.
fn direction(index: u32) -> Vec3 {
    let at = r2(index, 3);
    let y = 1.0 - 2.0 * at.x;
    let (sin, cos) = (std::f32::consts::TAU * at.y).sin_cos();
    Vec3::new(cos, 0.0, sin) * (1.0 - y * y).sqrt() + Vec3::Y * y
}

/// Returns the directions of rays from `eye` that hit nothing, and of those that hit the back of a surface.
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
fn rays_leave_the_gallery_only_through_the_windows() {
    let scene = builtin::gallery();
    for camera in &scene.cameras {
        let (void, behind) = leaks(&scene, camera.position);
        assert!(behind.is_empty(), "{}: back faces are visible towards {:?}", camera.name, behind[0]);
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
    // Three windows of 1.2 m x 1.2 m are projected onto 6.0 m x 7.2 m of floor. Columns and steps shade a part.
    let share = num_sunlit as f32 / 10_000.0;
    let windows = 3.0 * 1.2 * 1.2 * (0.975 / 0.8) / (6.0 * 7.2);
    assert!(share > 0.4 * windows && share < windows, "{share} of {windows}");
}
