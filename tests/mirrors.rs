//! Caustics of mirrors and panes: compared with closed forms, and two passes compared with path tracing.

use std::f32::consts::PI;

use glam::Vec3;
use hemicube::bake::{BakeSettings, Quality, bake};
use hemicube::base::ids::GroupId;
use hemicube::base::progress::Unwatched;
use hemicube::form_factor::point_to_polygon;
use hemicube::raytrace::{
    Ambient, Film, MeasuringPoint, PathSettings, TwoPassSettings, irradiance, path_traced, two_pass,
};
use hemicube::scene::{Camera, Light, Material, Scene, SceneBuilder};
use hemicube::trace::Tracer;

use crate::support::quads::{Quads, paint, slot, square_camera, texture};
use crate::support::scenes::{glowing, with_groups};

/// Computes the mean radiance of a picture.
fn mean(film: &Film) -> Vec3 {
    let radiance = film.radiance();
    radiance.iter().map(|&[r, g, b, _]| Vec3::new(r, g, b)).sum::<Vec3>() / radiance.len() as f32
}

fn second_pass(quads: &Quads, ambient: Ambient) -> Vec3 {
    let settings = TwoPassSettings { samples: 64, ambient, seed: 0 };
    let tracer = Tracer::new(&quads.baked.scene);
    mean(&two_pass(&tracer, &quads.baked, &square_camera(), [16; 2], &settings, &Unwatched))
}

fn by_paths(scene: &Scene, samples: u32) -> Vec3 {
    let settings = PathSettings { samples, ..PathSettings::default() };
    mean(&path_traced(&Tracer::new(scene), &square_camera(), [16; 2], &settings, &Unwatched))
}

fn silver() -> Material {
    Material { metallic: 1.0, roughness: 0.0, ..paint(Vec3::splat(0.9)) }
}

/// Builds a lamp that faces away from a square, and a mirror above both.
fn lamp_in_a_mirror() -> Quads {
    let mut quads = Quads::square(paint(Vec3::splat(0.05)), Vec3::ZERO);
    let lamp = Material { emission: Vec3::splat(5.0), group: Some(GroupId(0)), ..paint(Vec3::ZERO) };
    let lamp = quads.material(lamp);
    quads.quad(Vec3::new(3.0, -0.5, 1.0), Vec3::X, Vec3::Y, lamp);
    let mirror = quads.material(silver());
    quads.quad(Vec3::new(6.0, -4.0, 2.0), -8.0 * Vec3::X, 8.0 * Vec3::Y, mirror);
    quads.light(GroupId(0), |_| Vec3::ZERO, |_| Vec3::ZERO);
    quads
}

#[test]
fn a_mirror_reflects_the_light_of_a_lamp_on_to_a_square_behind_the_lamp() {
    let quads = lamp_in_a_mirror();
    // The form factor to the lamp's image is averaged over the square by the midpoint rule.
    let image = [(3.0, -0.5), (3.0, 0.5), (4.0, 0.5), (4.0, -0.5)].map(|(x, y)| Vec3::new(x, y, 3.0));
    let steps = 40;
    let at = |i: i32| Vec3::new((i % steps) as f32 + 0.5, (i / steps) as f32 + 0.5, 0.0) * (2.0 / steps as f32);
    let squares = 0..steps * steps;
    let factors = squares.map(|i| point_to_polygon(at(i) - Vec3::new(1.0, 1.0, 0.0), Vec3::Z, &image));
    let exact = 0.05 * 0.9 * 5.0 * factors.sum::<f32>() / (steps * steps) as f32;
    for (name, found) in [
        ("two passes", second_pass(&quads, Ambient::Indirect { final_gather: 0 })),
        ("final gather", second_pass(&quads, Ambient::Indirect { final_gather: 1 })),
        ("paths", by_paths(&quads.baked.scene, 4096)),
    ] {
        // Metal reflects a little more at an angle, 0.1 (1 - cos)^5, and reflects light of the square back to it.
        // Together this is less than 1 % of 0.9.
        assert!(found.x > 0.985 * exact && found.x < 1.02 * exact, "{name}: {found} for {exact}");
    }
    assert_eq!(second_pass(&quads, Ambient::None), Vec3::ZERO);
}

#[test]
fn the_highlight_of_a_small_lamp_in_rough_metal_has_little_noise() {
    let mut quads = Quads::square(Material { roughness: 0.4, ..silver() }, Vec3::ZERO);
    let lamp = Material { emission: Vec3::splat(10.0), group: Some(GroupId(0)), ..paint(Vec3::ZERO) };
    let lamp = quads.material(lamp);
    quads.quad(Vec3::new(1.2, -0.2, 1.2), 0.4 * Vec3::Y, 0.4 * Vec3::X, lamp);
    quads.light(GroupId(0), |_| Vec3::ZERO, |_| Vec3::ZERO);
    let film = |ambient, samples| {
        let settings = TwoPassSettings { samples, ambient, seed: 0 };
        let tracer = Tracer::new(&quads.baked.scene);
        two_pass(&tracer, &quads.baked, &square_camera(), [16; 2], &settings, &Unwatched)
    };
    // With `Ambient::All` rays hit lamps by chance only. There is no stored light here.
    let chance = film(Ambient::All, 4096);
    let paths = path_traced(
        &Tracer::new(&quads.baked.scene),
        &square_camera(),
        [16; 2],
        &PathSettings { samples: 256, ..PathSettings::default() },
        &Unwatched,
    );
    for found in [film(Ambient::None, 256), paths] {
        let error = found.noise().mean.hypot(chance.noise().mean);
        let difference = (mean(&found) / mean(&chance) - 1.0).abs().max_element();
        assert!(error < 0.015 && difference < 4.0 * error, "{difference} is known to {error}");
    }
    let [aimed, chance] = [Ambient::None, Ambient::All].map(|ambient| film(ambient, 64).noise().pixel);
    assert!(aimed < 0.05 && aimed < 0.2 * chance, "{aimed} and {chance}");
}

#[test]
fn a_lamp_shines_through_a_pane() {
    let mut builder = SceneBuilder::default();
    let floor = builder.material(glowing(Vec3::splat(0.5), Vec3::ZERO));
    let lamp = builder.material(glowing(Vec3::ZERO, Vec3::splat(8.0)));
    let pane = builder.material(glowing(Vec3::ONE, Vec3::ZERO));
    let flat = |half: f32, y: f32| {
        [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)].map(|(x, z)| Vec3::new(half * x, y, half * z))
    };
    let mut down = flat(0.2, 2.0);
    down.reverse();
    builder.quad(flat(3.0, 0.0), floor);
    builder.quad(flat(3.0, 1.0), pane);
    builder.quad(down, lamp);
    let mut scene = with_groups(builder.build(), 1);
    scene.materials[2] = Material { transmission: 1.0, ior: 1.5, ..paint(Vec3::splat(0.5)) };
    let point = MeasuringPoint { position: Vec3::ZERO, normal: Vec3::Y };
    let settings = PathSettings { samples: 1 << 14, ..PathSettings::default() };
    let found = irradiance(&Tracer::new(&scene), &[point], &settings, &Unwatched).expect("nothing cancels")[0];
    // Nearly head-on: 4 % are reflected, half of the rest is the tint.
    let exact = 8.0 * 0.96 * 0.5 * point_to_polygon(Vec3::ZERO, Vec3::Y, &down);
    assert!((found.direct.x / exact - 1.0).abs() < 0.01, "{found:?} for {exact}");
    let position = Vec3::new(0.1, 2.0, 0.05);
    scene.materials[1].emission = Vec3::ZERO;
    scene.lights.push(Light::point(position, Vec3::splat(3.0)));
    scene.triangles.retain(|triangle| triangle.material.index() != 1);
    let found = irradiance(&Tracer::new(&scene), &[point], &settings, &Unwatched).expect("nothing cancels")[0];
    let exact = 3.0 * 0.96 * 0.5 * position.y / position.length().powi(3);
    assert!((found.direct.x / exact - 1.0).abs() < 1e-3, "{found:?} for {exact}");
}

/// Builds a closed room with a lamp. One wall is a mirror, and half of the floor lies under a pane.
fn room_with_a_mirror() -> Scene {
    let mut builder = SceneBuilder::default();
    let white = builder.material(glowing(Vec3::new(0.7, 0.6, 0.5), Vec3::ZERO));
    let mirror = builder.material(glowing(Vec3::ONE, Vec3::ZERO));
    let lamp = builder.material(glowing(Vec3::splat(0.5), Vec3::splat(20.0)));
    let pane = builder.material(glowing(Vec3::ONE, Vec3::ZERO));
    builder.room(Vec3::ZERO, Vec3::splat(2.0), [white, white, mirror, white, white, white]);
    let under_ceiling = |x: f32, z: f32| Vec3::new(x, 1.9, z);
    builder.quad([(1.2, 0.7), (1.7, 0.7), (1.7, 1.2), (1.2, 1.2)].map(|(x, z)| under_ceiling(x, z)), lamp);
    let above_floor = |x: f32, z: f32| Vec3::new(x, 0.5, z);
    builder.quad([(0.0, 0.0), (0.0, 1.0), (2.0, 1.0), (2.0, 0.0)].map(|(x, z)| above_floor(x, z)), pane);
    let mut scene = with_groups(builder.build(), 1);
    scene.materials[1] = silver();
    scene.materials[3] = Material { transmission: 1.0, ..paint(Vec3::new(0.5, 0.9, 0.7)) };
    scene
}

#[test]
fn two_passes_equal_paths_in_a_room_with_mirrors_and_panes() {
    let scene = room_with_a_mirror();
    let settings = BakeSettings { element_size: Some(0.1), ..BakeSettings::preset(Quality::Draft) };
    let baked = bake(&scene, &settings).expect("small").baked;
    let eye = Camera::looking_at("inside", Vec3::new(1.8, 1.2, 1.9), Vec3::new(0.7, 0.4, 0.6), 1.2);
    let paths = PathSettings { samples: 1024, ..PathSettings::default() };
    let truth = mean(&path_traced(&Tracer::new(&scene), &eye, [16; 2], &paths, &Unwatched));
    for (final_gather, samples) in [(0, 64), (4, 32)] {
        let settings = TwoPassSettings { samples, ambient: Ambient::Indirect { final_gather }, seed: 0 };
        let tracer = Tracer::new(&baked.scene);
        let found = mean(&two_pass(&tracer, &baked, &eye, [16; 2], &settings, &Unwatched));
        assert!((found / truth - 1.0).abs().max_element() < 0.02, "{final_gather}: {found} for {truth}");
    }
}

#[test]
fn a_normal_map_tilts_the_surface_towards_the_light() {
    // Normals of the texels are tilted by 36.9 degrees, to the right and up.
    for (texel, lean) in
        [([204, 128, 230, 255], Vec3::new(0.6, 0.0, 0.8)), ([128, 204, 230, 255], Vec3::new(0.0, 0.6, 0.8))]
    {
        let relief = Material { normal_texture: Some((slot(0), 1.0)), ..paint(Vec3::splat(0.5)) };
        let mut quads = Quads::square(relief, Vec3::ZERO);
        quads.baked.scene.textures.push(texture(1, &[texel]));
        quads.baked.scene.lights.push(Light::directional(-lean, Vec3::splat(PI)));
        // A surface that faces the sun shows its reflectance.
        let found = second_pass(&quads, Ambient::None);
        assert!((found.x - 0.5).abs() < 0.003, "{lean}: {found}");
        quads.baked.scene.materials[0].normal_texture = None;
        let flat = second_pass(&quads, Ambient::None);
        assert!((flat.x - 0.4).abs() < 1e-3, "{lean}: {flat}");
    }
}
