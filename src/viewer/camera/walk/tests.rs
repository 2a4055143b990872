//! Walks through small scenes of rectangles.

use glam::Vec3;

use super::*;
use crate::scene::{Material, SceneBuilder};
use crate::viewer::camera::collider::Collider;

const FRAME: f32 = 1.0 / 60.0;

/// Builds a scene of quadrilaterals.
fn world(quads: &[[Vec3; 4]]) -> Collider {
    let mut builder = SceneBuilder::default();
    let grey = builder.material(Material::diffuse(Vec3::splat(0.5)));
    for &quad in quads {
        builder.quad(quad, grey);
    }
    Collider::new(&builder.build())
}

/// Returns a level rectangle at height `y`.
fn level(y: f32, x: [f32; 2], z: [f32; 2]) -> [Vec3; 4] {
    [(0, 1), (1, 1), (1, 0), (0, 0)].map(|(i, j)| Vec3::new(x[i], y, z[j]))
}

/// Returns a vertical wall at `z`.
fn wall(z: f32, x: [f32; 2], y: [f32; 2]) -> [Vec3; 4] {
    [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(i, j)| Vec3::new(x[i], y[j], z))
}

fn floor() -> [Vec3; 4] {
    level(0.0, [-10.0, 10.0], [-10.0, 10.0])
}

fn walker(at: Vec3, collider: &Collider) -> Walker {
    Walker::land(Body::of_scale(1.0), at + Vec3::Y * 1.65, collider).expect("a floor")
}

/// Walks at `velocity` for `seconds` in frames of `frame` seconds.
fn walk(walker: &mut Walker, velocity: Vec3, seconds: f32, frame: f32, collider: &Collider) {
    for _ in 0..(seconds / frame).round() as usize {
        walker.advance(velocity * frame, frame, collider);
    }
}

#[test]
fn the_eye_keeps_its_height_above_the_floor() {
    let world = world(&[floor()]);
    let mut walker = walker(Vec3::ZERO, &world);
    walk(&mut walker, Vec3::new(1.5, 0.0, 1.0), 2.0, FRAME, &world);
    assert!((walker.eye() - Vec3::new(3.0, 1.65, 2.0)).length() < 1e-3, "{}", walker.eye());
    assert!(!walker.is_moving());
}

#[test]
fn a_walker_above_the_floor_falls_on_to_it() {
    let world = world(&[floor(), level(3.0, [-1.0, 1.0], [-1.0, 1.0])]);
    let mut walker = walker(Vec3::new(0.0, 3.0, 0.0), &world);
    walk(&mut walker, Vec3::X * 2.0, 1.0, FRAME, &world);
    assert!(walker.is_moving() && walker.eye().y < 4.65 && walker.eye().y > 1.65, "{}", walker.eye());
    walk(&mut walker, Vec3::ZERO, 2.0, FRAME, &world);
    assert!((walker.eye().y - 1.65).abs() < 1e-4, "{}", walker.eye());
}

#[test]
fn walkers_slide_along_walls() {
    let world = world(&[floor(), wall(-2.0, [-10.0, 10.0], [0.0, 3.0])]);
    let mut walker = walker(Vec3::ZERO, &world);
    walk(&mut walker, Vec3::new(1.0, 0.0, -2.0), 4.0, FRAME, &world);
    let eye = walker.eye();
    assert!((eye.z + 1.75).abs() < 0.01, "a body's radius from the wall, not {eye}");
    assert!((eye.x - 4.0).abs() < 0.05, "{eye}");
}

#[test]
fn long_frames_do_not_pass_through_thin_walls() {
    let world = world(&[floor(), wall(-2.0, [-10.0, 10.0], [0.0, 3.0])]);
    for frame in [0.25, 1.0] {
        let mut walker = walker(Vec3::ZERO, &world);
        walk(&mut walker, Vec3::NEG_Z * 12.0, 2.0, frame, &world);
        assert!(walker.eye().z > -2.0, "{frame}: {}", walker.eye());
    }
}

#[test]
fn walkers_stay_in_corners() {
    let side =
        [Vec3::new(2.0, 0.0, -5.0), Vec3::new(2.0, 0.0, 5.0), Vec3::new(2.0, 3.0, 5.0), Vec3::new(2.0, 3.0, -5.0)];
    let world = world(&[floor(), wall(-2.0, [-10.0, 10.0], [0.0, 3.0]), side]);
    let mut walker = walker(Vec3::ZERO, &world);
    walk(&mut walker, Vec3::new(3.0, 0.0, -3.0), 3.0, FRAME, &world);
    let eye = walker.eye();
    assert!((eye.x - 1.75).abs() < 0.02 && (eye.z + 1.75).abs() < 0.02, "{eye}");
}

/// Returns six steps up to a landing; the first is at z = -1.
fn stairs(rise: f32) -> Vec<[Vec3; 4]> {
    let mut quads = vec![floor()];
    for step in 0..6 {
        let (z, y) = (-1.0 - 0.3 * step as f32, rise * step as f32);
        quads.push(wall(z, [-1.0, 1.0], [y, y + rise]));
        quads.push(level(y + rise, [-1.0, 1.0], [z - if step == 5 { 4.0 } else { 0.3 }, z]));
    }
    quads
}

#[test]
fn stairs_are_climbed_and_descended_at_any_frame_rate() {
    let world = world(&stairs(0.18));
    for frame in [FRAME, 0.1, 0.25] {
        let mut walker = walker(Vec3::ZERO, &world);
        walk(&mut walker, Vec3::NEG_Z * 2.0, 2.0, frame, &world);
        walk(&mut walker, Vec3::ZERO, 1.0, frame, &world);
        assert!((walker.eye() - Vec3::new(0.0, 6.0 * 0.18 + 1.65, -4.0)).length() < 0.02, "{frame}: {}", walker.eye());
        walk(&mut walker, Vec3::Z * 2.0, 2.0, frame, &world);
        walk(&mut walker, Vec3::ZERO, 1.0, frame, &world);
        assert!((walker.eye() - Vec3::Y * 1.65).length() < 0.02, "{frame}: {}", walker.eye());
    }
}

#[test]
fn the_eye_rises_smoothly_on_stairs() {
    let world = world(&stairs(0.18));
    let mut walker = walker(Vec3::ZERO, &world);
    let mut last = walker.eye().y;
    for _ in 0..120 {
        walker.advance(Vec3::NEG_Z * 2.0 * FRAME, FRAME, &world);
        assert!(walker.eye().y - last < 0.06, "a jump of {}", walker.eye().y - last);
        last = walker.eye().y;
    }
}

#[test]
fn obstacles_higher_than_a_step_are_walls() {
    let world = world(&stairs(0.6));
    let mut walker = walker(Vec3::ZERO, &world);
    walk(&mut walker, Vec3::NEG_Z * 2.0, 3.0, FRAME, &world);
    assert!((walker.eye().y - 1.65).abs() < 1e-3 && walker.eye().z > -0.9, "{}", walker.eye());
}

#[test]
fn steps_below_a_low_ceiling_are_not_climbed() {
    let mut quads = stairs(0.3);
    quads.push(level(1.9, [-1.0, 1.0], [-4.0, -0.5]));
    let world = world(&quads);
    let mut walker = walker(Vec3::ZERO, &world);
    walk(&mut walker, Vec3::NEG_Z * 2.0, 2.0, FRAME, &world);
    assert!(walker.eye().y < 1.9, "{}", walker.eye());
}

#[test]
fn ramps_are_climbed_and_cliffs_are_not() {
    let ramp = |height: f32| {
        let (low, high) = ([-10.0, 10.0], height);
        [
            Vec3::new(low[0], 0.0, -1.0),
            Vec3::new(low[1], 0.0, -1.0),
            Vec3::new(low[1], high, -3.0),
            Vec3::new(low[0], high, -3.0),
        ]
    };
    for (height, is_walkable) in [(1.0, true), (2.0, true), (3.2, false), (8.0, false)] {
        let world = world(&[floor(), ramp(height)]);
        let mut walker = walker(Vec3::ZERO, &world);
        walk(&mut walker, Vec3::NEG_Z * 2.0, 1.25, FRAME, &world);
        assert_eq!(walker.eye().y > 1.65 + 0.3 * height, is_walkable, "{height}: {}", walker.eye());
    }
}

#[test]
fn gaps_are_passed_if_they_are_wide_enough() {
    let world = world(&[floor(), wall(-2.0, [-10.0, -0.3], [0.0, 3.0]), wall(-2.0, [0.3, 10.0], [0.0, 3.0])]);
    let mut walker = walker(Vec3::new(0.2, 0.0, 0.0), &world);
    walk(&mut walker, Vec3::NEG_Z * 2.0, 2.0, FRAME, &world);
    assert!(walker.eye().z < -3.0, "{}", walker.eye());
}

#[test]
fn walkers_return_after_falling_out_of_the_scene() {
    let world = world(&[level(0.0, [-1.0, 1.0], [-1.0, 1.0])]);
    let mut walker = walker(Vec3::ZERO, &world);
    walk(&mut walker, Vec3::X * 2.0, 1.0, FRAME, &world);
    walk(&mut walker, Vec3::ZERO, 10.0, FRAME, &world);
    assert!((walker.eye().y - 1.65).abs() < 1e-3, "{}", walker.eye());
    assert!(walker.eye().x.abs() < 1.3, "{}", walker.eye());
}

#[test]
fn walking_needs_a_floor() {
    let world = world(&[level(0.0, [-1.0, 1.0], [-1.0, 1.0])]);
    assert!(Walker::land(Body::of_scale(1.0), Vec3::new(5.0, 1.0, 0.0), &world).is_none());
}

/// Walks towards a point of the floor plan and fails if that takes too long.
fn walk_to(walker: &mut Walker, x: f32, z: f32, collider: &Collider) {
    const SPEED: f32 = 2.0;
    for _ in 0..1200 {
        let way = Vec3::new(x - walker.eye().x, 0.0, z - walker.eye().z);
        if way.length() < 0.1 {
            return;
        }
        walker.advance(way.normalize() * SPEED * FRAME, FRAME, collider);
    }
    panic!("stuck at {} on the way to {x}, {z}", walker.eye());
}

#[test]
fn the_gallery_is_walkable_through_its_door_and_up_its_steps() {
    let gallery = Collider::new(&crate::scene::builtin::by_name("gallery").expect("it is built in"));
    let mut walker = walker(Vec3::new(-2.0, 0.0, 3.6), &gallery);
    for (x, z, floor) in [(1.5, 3.6, 0.0), (6.2, 3.6, 0.0), (9.2, 3.6, 1.02), (6.2, 3.6, 0.0), (-2.0, 3.6, 0.0)] {
        walk_to(&mut walker, x, z, &gallery);
        walk(&mut walker, Vec3::ZERO, 0.5, FRAME, &gallery);
        assert!((walker.eye().y - 1.65 - floor).abs() < 0.02, "{} at {x}, {z}", walker.eye());
    }
}

#[test]
fn a_random_walk_stays_in_the_gallery() {
    use crate::base::sampling::{hash, unit_float};
    let gallery = Collider::new(&crate::scene::builtin::by_name("gallery").expect("it is built in"));
    let bounds = gallery.bounds();
    let mut walker = walker(Vec3::new(3.0, 0.0, 3.6), &gallery);
    for step in 0..400 {
        let dice = |salt: u32| unit_float(hash(7 * step + salt));
        let direction = Vec3::new(dice(1) - 0.5, 0.0, dice(2) - 0.5).normalize_or_zero();
        // Frames from short to very long, speeds from slow to running.
        let frame = 0.25 * dice(3) + 0.001;
        walk(&mut walker, direction * 5.0 * dice(4), 0.5, frame, &gallery);
        let eye = walker.eye();
        assert!(eye.cmpgt(bounds.low).all() && eye.cmplt(bounds.high).all(), "step {step}: {eye}");
    }
}
