//! The ray-traced reference compared with closed forms: where the line to the light crosses a caster.

use glam::{Vec2, Vec3};
use hemicube::scene::LightKind;

use super::stage::{SIZE, Stage, raytraced};
use crate::support::device::gpu;

/// Returns where the line from `point` to `light` crosses the height `height`.
fn crossing(point: Vec3, light: Vec3, height: f32) -> Vec2 {
    let at = point + (light - point) * ((height - point.y) / (light.y - point.y));
    Vec2::new(at.x, at.z)
}

#[test]
fn the_shadow_of_a_quad_is_its_image_from_the_light() {
    let Some(gpu) = gpu() else { return };
    let light = Vec3::new(0.7, 4.0, 0.4);
    let mut stage = Stage::new();
    // The camera sees the floor beside the quad.
    stage.quad(Vec3::new(-0.6, 1.5, 0.5), 1.2 * Vec3::X, -1.0 * Vec3::Z);
    stage.light(LightKind::Point { position: light });
    stage.seen(Vec3::new(0.0, 1.2, 7.0), Vec3::new(0.0, -1.0, 0.0));
    let found = stage.shot(gpu).decisions(gpu, &raytraced());
    let (mut num_dark, mut num_lit) = (0, 0);
    for (x, y) in (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y))) {
        let point = stage.floor_under(x, y);
        let is_on_floor = point.y.abs() < 1e-3 && point.x.abs() < 3.9 && point.z.abs() < 3.9;
        let over = crossing(point, light, 1.5);
        // Depth of the crossing inside the quad, negative outside.
        let depth = (0.6 - over.x.abs()).min(0.5 - over.y).min(over.y + 0.5);
        if !is_on_floor || depth.abs() < 1e-4 {
            continue;
        }
        let is_lit = found.samples[0].lit[(y * SIZE[0] + x) as usize];
        assert_eq!(is_lit, depth < 0.0, "pixel {x}, {y} at {point}, {depth} m within the shadow");
        if is_lit { num_lit += 1 } else { num_dark += 1 }
    }
    assert!(num_dark > 300 && num_lit > 3000, "{num_dark} dark, {num_lit} lit");
}

#[test]
fn the_shadow_of_a_round_body_is_that_of_its_triangles() {
    let Some(gpu) = gpu() else { return };
    let (light, centre) = (Vec3::new(0.7, 4.0, 0.4), Vec3::new(0.0, 1.3, 0.0));
    let mut stage = Stage::new();
    stage.sphere(centre, 1.0);
    stage.light(LightKind::Point { position: light });
    let found = stage.shot(gpu).decisions(gpu, &raytraced());
    let mut num_dark = 0;
    for (x, y) in (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y))) {
        let (point, eye) = (stage.floor_under(x, y), stage.camera.position);
        let distance = |from: Vec3| (centre - from).reject_from((point - from).normalize()).length();
        let is_on_floor = point.y.abs() < 1e-3 && point.x.abs() < 3.9 && point.z.abs() < 3.9;
        if !is_on_floor || distance(eye) < 1.0 {
            continue;
        }
        // The triangles lie between the sphere and a smaller one; the radii differ by the height of an arc of 18
        // degrees.
        let is_lit = found.samples[0].lit[(y * SIZE[0] + x) as usize];
        // A line of sight begins a ten-thousandth of a metre in front of the floor.
        if distance(light) > 1.001 {
            assert!(is_lit, "pixel {x}, {y} beside the ball");
        } else if distance(light) < 0.97 {
            assert!(!is_lit, "pixel {x}, {y} behind the ball");
            num_dark += 1;
        }
    }
    assert!(num_dark > 200, "{num_dark}");
}
