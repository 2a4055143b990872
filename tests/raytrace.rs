//! Ray tracing compared with closed forms (furnaces, form factors, mirrors, panes) and with the bake.

use std::f32::consts::{FRAC_1_PI, PI};

use glam::Vec3;
use hemicube::bake::{BakeContext, BakeSettings, Method, Quality, Solver, bake, bake_with};
use hemicube::baked::BakedScene;
use hemicube::base::ids::GroupId;
use hemicube::base::progress::Unwatched;
use hemicube::form_factor::point_to_polygon;
use hemicube::raytrace::{
    Ambient, Film, Irradiance, MeasuringPoint, PathSettings, TwoPassSettings, irradiance, path_traced, two_pass,
};
use hemicube::scene::{AlphaMode, Camera, Light, Material, Scene, SceneBuilder};
use hemicube::trace::Tracer;

use crate::support::device::gpu;
use crate::support::quads::{Quads, paint, slot, square_camera, texture};
use crate::support::scenes::{self, glowing, with_groups};

fn measure(scene: &Scene, position: Vec3, normal: Vec3, settings: &PathSettings) -> Irradiance {
    let point = MeasuringPoint { position, normal };
    irradiance(&Tracer::new(scene), &[point], settings, &Unwatched).expect("nobody cancels")[0]
}

/// Asserts that the standard error of the estimate is small, and that the estimate is within four of them.
#[track_caller]
fn assert_close(estimate: Vec3, error: Vec3, exact: Vec3) {
    assert!(error.cmple(0.02 * exact.abs() + 1e-6).all(), "{estimate} is known to {error} only");
    assert!((estimate - exact).abs().cmple(4.0 * error + 1e-4 * exact).all(), "{estimate} +- {error} for {exact}");
}

/// Computes the mean radiance of a picture.
fn mean(film: &Film) -> Vec3 {
    let radiance = film.radiance();
    radiance.iter().map(|&[r, g, b, _]| Vec3::new(r, g, b)).sum::<Vec3>() / radiance.len() as f32
}

fn by_paths(scene: &Scene, camera: &Camera, settings: &PathSettings) -> Film {
    path_traced(&Tracer::new(scene), camera, [16; 2], settings, &Unwatched)
}

fn by_two_passes(quads: &Quads, ambient: Ambient) -> Film {
    let settings = TwoPassSettings { samples: 64, ambient, seed: 0 };
    let tracer = Tracer::new(&quads.baked.scene);
    two_pass(&tracer, &quads.baked, &square_camera(), [16; 2], &settings, &Unwatched)
}

#[test]
fn each_bounce_in_a_furnace_adds_its_share() {
    let (reflectance, exitance) = (Vec3::new(0.5, 0.8, 0.2), Vec3::new(1.0, 2.0, 3.0));
    let scene = scenes::furnace(reflectance, exitance);
    let eye = Camera::looking_at("inside", Vec3::splat(0.5), Vec3::new(0.9, 0.3, 0.1), 1.0);
    let mut sum = Vec3::ZERO;
    let mut share = Vec3::ONE;
    for max_bounces in 0..4 {
        sum += exitance * share;
        share *= reflectance;
        let settings = PathSettings { samples: 4096, max_bounces, ..PathSettings::default() };
        let found = measure(&scene, Vec3::new(0.3, 0.0, 0.8), Vec3::Y, &settings);
        assert_close(found.total, found.total_error, sum);
        assert_close(found.direct, found.direct_error, exitance);
        let seen = mean(&by_paths(&scene, &eye, &PathSettings { samples: 64, ..settings }));
        assert!((seen * PI / sum - 1.0).abs().max_element() < 0.01, "{max_bounces}: {seen} for {}", sum / PI);
    }
    let found =
        measure(&scene, Vec3::new(0.3, 0.0, 0.8), Vec3::Y, &PathSettings { samples: 8192, ..PathSettings::default() });
    assert_close(found.total, found.total_error, exitance / (1.0 - reflectance));
}

/// Builds a lamp that faces down, and a floor below it.
fn lamp_over(floor_reflectance: f32) -> (Scene, [Vec3; 4]) {
    let mut builder = SceneBuilder::default();
    let lamp = builder.material(glowing(Vec3::ZERO, Vec3::new(4.0, 2.0, 1.0)));
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.5), (0.0, 0.5)].map(|(x, z)| Vec3::new(x, 1.0, z));
    builder.quad(corners, lamp);
    let floor = builder.material(glowing(Vec3::splat(floor_reflectance), Vec3::ZERO));
    let at = |x: f32, z: f32| Vec3::new(x, 0.0, z);
    builder.quad([at(-1.0, -1.0), at(-1.0, 2.0), at(2.0, 2.0), at(2.0, -1.0)], floor);
    (with_groups(builder.build(), 1), corners)
}

#[test]
fn a_lamp_lights_a_point_by_its_form_factor_and_nothing_behind_it() {
    let (scene, lamp) = lamp_over(0.0);
    let settings = PathSettings { samples: 4096, ..PathSettings::default() };
    for position in [Vec3::new(0.2, 0.0, 0.3), Vec3::new(0.9, 0.97, 0.4), Vec3::new(1.9, 0.0, -0.8)] {
        let found = measure(&scene, position, Vec3::Y, &settings);
        let exact = Vec3::new(4.0, 2.0, 1.0) * point_to_polygon(position, Vec3::Y, &lamp);
        assert_close(found.total, found.total_error, exact);
        assert_eq!(found.total, found.direct);
    }
    assert_eq!(measure(&scene, Vec3::new(0.5, 2.0, 0.2), Vec3::NEG_Y, &settings).total, Vec3::ZERO);
}

#[test]
fn one_bounce_of_a_point_light_is_an_integral_over_the_floor() {
    let mut builder = SceneBuilder::default();
    let floor = builder.material(glowing(Vec3::splat(0.5), Vec3::ZERO));
    let at = |x: f32, z: f32| Vec3::new(x, 0.0, z);
    builder.quad([at(-1.0, -1.0), at(-1.0, 1.0), at(1.0, 1.0), at(1.0, -1.0)], floor);
    let (lamp, intensity) = (Vec3::new(0.3, 0.8, 0.1), 100.0);
    builder.light(Light::point(lamp, Vec3::splat(intensity)));
    let scene = with_groups(builder.build(), 1);
    let eye = Vec3::new(-0.2, 1.0, 0.0);
    let found = measure(&scene, eye, Vec3::NEG_Y, &PathSettings { samples: 4096, ..PathSettings::default() });
    // The integral over the floor by the midpoint rule.
    let (mut exact, steps) = (0.0, 400);
    for i in 0..steps * steps {
        let [x, z] = [i % steps, i / steps].map(|k| (k as f32 + 0.5) * 2.0 / steps as f32 - 1.0);
        let (to_lamp, to_eye) = (lamp - at(x, z), eye - at(x, z));
        let irradiance = intensity * to_lamp.y / to_lamp.length().powi(3);
        exact += 0.5 * FRAC_1_PI * irradiance * to_eye.y * to_eye.y / to_eye.length().powi(4);
    }
    exact *= (2.0 / steps as f32).powi(2);
    assert_close(found.total - found.direct, found.total_error, Vec3::splat(exact));
    // Direct light of a punctual light needs no random choice.
    let to_lamp = lamp - eye;
    let direct = intensity * -to_lamp.y / to_lamp.length().powi(3);
    assert!((found.direct.x / direct - 1.0).abs() < 1e-4 && found.direct_error == Vec3::ZERO, "{found:?} for {direct}");
}

#[test]
fn few_paths_find_the_bright_spot_of_a_point_light_beside_a_ceiling() {
    let mut builder = SceneBuilder::default();
    let ceiling = builder.material(glowing(Vec3::splat(0.5), Vec3::ZERO));
    let at = |x: f32, z: f32| Vec3::new(x, 0.0, z);
    builder.quad([at(-1.0, -1.0), at(-1.0, 1.0), at(1.0, 1.0), at(1.0, -1.0)], ceiling);
    let (height, intensity) = (0.01, 100.0);
    builder.light(Light::point(Vec3::new(0.3, height, 0.1), Vec3::splat(intensity)));
    let scene = with_groups(builder.build(), 1);
    let eye = Vec3::new(0.3, 1.5, 0.1);
    let found = measure(&scene, eye, Vec3::NEG_Y, &PathSettings { samples: 1024, ..PathSettings::default() });
    // Half of the light falls on the ceiling. The integral over the ceiling is computed by the midpoint rule.
    let (mut exact, steps) = (0.0, 400);
    for i in 0..steps * steps {
        let [part, turn] = [i % steps, i / steps].map(|k| (k as f32 + 0.5) / steps as f32);
        let radius = height * (1.0 / (part * part) - 1.0).sqrt();
        let (sin, cos) = (2.0 * PI * turn).sin_cos();
        let lit = Vec3::new(0.3 + radius * cos, 0.0, 0.1 + radius * sin);
        if lit.abs().max_element() < 1.0 {
            exact += eye.y * eye.y / eye.distance_squared(lit).powi(2);
        }
    }
    exact *= 0.5 * FRAC_1_PI * 2.0 * PI * intensity / (steps * steps) as f32;
    let indirect = found.total - found.direct;
    assert_close(indirect, found.total_error, Vec3::splat(exact));
}

#[test]
fn a_lamp_with_a_pattern_lights_as_its_bright_half() {
    let mut quads = Quads::with_groups(1);
    quads.baked.scene.textures.push(texture(2, &[[0, 0, 0, 255], [255, 255, 255, 255]]));
    let glow = Material {
        emission: Vec3::splat(2.0),
        emissive_texture: Some(slot(0)),
        group: Some(GroupId(0)),
        ..paint(Vec3::ZERO)
    };
    let lamp = quads.material(glow);
    quads.quad(Vec3::new(-1.0, -1.0, 0.0), 2.0 * Vec3::X, 2.0 * Vec3::Y, lamp);
    let position = Vec3::new(-0.4, 0.3, 0.7);
    let found =
        measure(&quads.baked.scene, position, Vec3::NEG_Z, &PathSettings { samples: 4096, ..PathSettings::default() });
    let bright = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y].map(|p| Vec3::new(p.x, 2.0 * p.y - 1.0, 0.0));
    let exact = 2.0 * PI * point_to_polygon(position, Vec3::NEG_Z, &bright);
    assert_close(found.total, found.total_error, Vec3::splat(exact));
}

/// Builds a square of material `front`, and behind the camera a large wall that emits towards it.
fn before_a_shining_wall(front: Material, radiance: f32) -> Quads {
    let mut quads = Quads::square(front, Vec3::ZERO);
    let glow = Material { emission: Vec3::splat(radiance), group: Some(GroupId(0)), ..paint(Vec3::ZERO) };
    let wall = quads.material(glow);
    quads.quad(Vec3::new(50.0, -50.0, 5.0), -100.0 * Vec3::X, 100.0 * Vec3::Y, wall);
    quads.light(GroupId(0), |_| Vec3::ZERO, |_| Vec3::ZERO);
    quads
}

#[test]
fn a_mirror_shows_the_wall_behind_the_camera_in_the_colour_of_the_mirror() {
    let silver = Vec3::new(0.9, 0.8, 0.4);
    let mirror = Material { metallic: 1.0, roughness: 0.0, ..paint(silver) };
    let quads = before_a_shining_wall(mirror, 3.0);
    let scene = &quads.baked.scene;
    let truth = mean(&by_paths(scene, &square_camera(), &PathSettings { samples: 4, ..PathSettings::default() }));
    assert!((truth - 3.0 * silver).abs().max_element() < 1e-5, "{truth}");
    for ambient in [Ambient::Constant(Vec3::ONE), Ambient::None, Ambient::Indirect { final_gather: 0 }, Ambient::All] {
        let seen = mean(&by_two_passes(&quads, ambient));
        assert!((seen - truth).abs().max_element() < 1e-5, "{ambient:?}: {seen}");
    }
    let without = PathSettings { samples: 4, has_specular: false, ..PathSettings::default() };
    assert_eq!(mean(&by_paths(scene, &square_camera(), &without)), Vec3::ZERO);
}

#[test]
fn a_pane_shows_what_is_behind_it_and_a_faint_reflection() {
    let pane = Material { transmission: 1.0, ior: 1.5, ..paint(Vec3::splat(0.5)) };
    let mut quads = before_a_shining_wall(pane, 10.0);
    let glow = Material { emission: Vec3::ONE, group: Some(GroupId(0)), ..paint(Vec3::ZERO) };
    let behind = quads.material(glow);
    quads.quad(Vec3::new(-2.0, -2.0, -1.0), 4.0 * Vec3::X, 4.0 * Vec3::Y, behind);
    quads.light(GroupId(0), |_| Vec3::ZERO, |_| Vec3::ZERO);
    // Fresnel reflectance at normal incidence: ((1.5 - 1) / (1.5 + 1))^2.
    let exact = 0.04 * 10.0 + 0.96 * 0.5;
    let truth =
        by_paths(&quads.baked.scene, &square_camera(), &PathSettings { samples: 256, ..PathSettings::default() });
    for film in [truth, by_two_passes(&quads, Ambient::None)] {
        assert!((mean(&film).x / exact - 1.0).abs() < 0.02, "{} for {exact}", mean(&film));
    }
}

#[test]
fn a_surface_that_blends_lets_the_rest_of_the_light_pass() {
    let veil = Material { alpha_mode: AlphaMode::Blend, base_colour: Vec3::ZERO.extend(0.25), ..paint(Vec3::ZERO) };
    let mut quads = Quads::square(veil, Vec3::ZERO);
    let glow = Material { emission: Vec3::ONE, group: Some(GroupId(0)), ..paint(Vec3::ZERO) };
    let behind = quads.material(glow);
    quads.quad(Vec3::new(-0.25, -0.25, -0.5), 0.5 * Vec3::X, 0.5 * Vec3::Y, behind);
    let lamp = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| Vec3::new(0.25 * x, 0.25 * y, -0.5));
    let position = Vec3::new(0.1, 0.0, 0.5);
    let settings = PathSettings { samples: 1 << 14, ..PathSettings::default() };
    let found = measure(&quads.baked.scene, position, Vec3::NEG_Z, &settings);
    let exact = 0.75 * PI * point_to_polygon(position, Vec3::NEG_Z, &lamp);
    assert_close(found.total, found.total_error, Vec3::splat(exact));
}

#[test]
fn the_second_pass_adds_ambient_light_to_that_of_the_lamps() {
    let colour = Vec3::new(0.8, 0.5, 0.2);
    let mut quads = Quads::square(paint(colour), Vec3::ZERO);
    quads.light(GroupId(0), |_| Vec3::splat(2.0), |at| Vec3::splat(1.0 + at.x));
    let see = |quads: &Quads, ambient| mean(&by_two_passes(quads, ambient)) / colour;
    let expected = [
        (Ambient::None, 0.0),
        (Ambient::Constant(Vec3::splat(0.3)), 0.3),
        (Ambient::Indirect { final_gather: 0 }, FRAC_1_PI),
        (Ambient::All, 3.0 * FRAC_1_PI),
    ];
    for (ambient, radiance) in expected {
        let seen = see(&quads, ambient);
        assert!((seen - radiance).abs().max_element() < 1e-3, "{ambient:?}: {seen} for {radiance}");
    }
    // Two walls close together see only each other, so the gathered light is the light that the other wall reflects.
    let grey = quads.material(paint(Vec3::splat(0.5)));
    quads.quad(Vec3::new(50.0, -50.0, 0.01), -100.0 * Vec3::X, 100.0 * Vec3::Y, grey);
    quads.light(GroupId(0), |_| Vec3::splat(2.0), |_| Vec3::splat(1.0));
    let gathered = see(&quads, Ambient::Indirect { final_gather: 8 });
    assert!((gathered - 0.5 * 3.0 * FRAC_1_PI).abs().max_element() < 1e-3, "{gathered}");
}

/// Builds a room with a lamp under its ceiling.
fn lamp_room() -> Scene {
    let mut builder = SceneBuilder::default();
    let white = builder.material(glowing(Vec3::splat(0.7), Vec3::ZERO));
    let red = builder.material(glowing(Vec3::new(0.6, 0.1, 0.1), Vec3::ZERO));
    builder.room(Vec3::ZERO, Vec3::new(3.0, 2.0, 2.5), [white, white, red, white, white, white]);
    let lamp = builder.material(glowing(Vec3::ZERO, Vec3::splat(50.0)));
    let under_ceiling = |x: f32, z: f32| Vec3::new(x, 1.95, z);
    builder.quad([(1.0, 1.0), (2.0, 1.0), (2.0, 1.5), (1.0, 1.5)].map(|(x, z)| under_ceiling(x, z)), lamp);
    with_groups(builder.build(), 1)
}

/// Computes stored irradiance / irradiance by paths, each summed over vertices away from the edges of [`lamp_room`].
fn baked_over_paths(scene: &Scene, baked: &BakedScene, paths: &PathSettings) -> Vec3 {
    let light = &baked.light.groups[0];
    let vertices: Vec<usize> = (0..baked.scene.vertices.len()).step_by(7).collect();
    let points: Vec<_> = vertices
        .iter()
        .map(|&v| &baked.scene.vertices[v])
        .map(|vertex| MeasuringPoint { position: vertex.position, normal: vertex.normal })
        .collect();
    let truth = irradiance(&Tracer::new(scene), &points, paths, &Unwatched).unwrap();
    let (mut baked_sum, mut true_sum, mut num_inside) = (Vec3::ZERO, Vec3::ZERO, 0);
    for ((&v, point), found) in vertices.iter().zip(&points).zip(&truth) {
        // Points in the edges of the room lie on no single surface, and the back of the lamp is hidden.
        let inset =
            (point.position - 0.05).min(Vec3::new(2.95, 1.95, 2.45) - point.position) + 0.1 * point.normal.abs();
        if inset.min_element() > 0.0 && point.position.y < 1.9 {
            baked_sum += light.direct[v] + light.indirect[v];
            true_sum += found.total;
            num_inside += 1;
        }
    }
    assert!(num_inside > 50, "{num_inside}");
    baked_sum / true_sum
}

#[test]
fn radiosity_equals_path_tracing() {
    let Some(gpu) = gpu() else { return };
    let scene = lamp_room();
    let settings = BakeSettings { element_size: Some(0.15), ..BakeSettings::preset(Quality::Draft) };
    let baked = bake_with(&scene, &settings, &BakeContext::on(gpu)).unwrap().baked;
    let ratio = baked_over_paths(&scene, &baked, &PathSettings::default());
    assert!((ratio - 1.0).abs().max_element() < 0.02, "{ratio}");
}

#[test]
fn the_k_th_gathering_pass_equals_paths_of_k_reflections() {
    let scene = lamp_room();
    for passes in 1..=3 {
        let settings = BakeSettings {
            element_size: Some(0.15),
            method: Some(Method::Hemisphere),
            solver: Solver::Gathering,
            passes: Some(passes),
            hemisphere_rays: 1024,
            ..BakeSettings::preset(Quality::Draft)
        };
        let baked = bake(&scene, &settings).unwrap().baked;
        // Irradiance does not include the reflection at the surface itself, so paths have one bounce less.
        let paths = PathSettings { max_bounces: passes as u32 - 1, ..PathSettings::default() };
        let ratio = baked_over_paths(&scene, &baked, &paths);
        assert!((ratio - 1.0).abs().max_element() < 0.01, "pass {passes}: {ratio}");
    }
}
