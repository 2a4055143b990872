//! Noise of gathered light: how much there is can be told from one look, and several looks take it away.

use glam::Vec3;
use hemicube::bake::{BakeSettings, Quality, bake};
use hemicube::base::progress::Unwatched;
use hemicube::base::sampling::{hash, r2};
use hemicube::form_factor::hemisphere::Hemispheres;
use hemicube::form_factor::{Viewpoint, map_rows};
use hemicube::patch::{MeshSettings, PatchMesh};
use hemicube::radiosity::Field;
use hemicube::radiosity::gather::{GatherSettings, Gatherer};
use hemicube::radiosity::noise::{Noise, irradiance_and_variance};
use hemicube::scene::{Light, Scene, SceneBuilder};
use hemicube::trace::Tracer;

use crate::support::scenes::{self, glowing, with_groups};

const NUM_RAYS: u32 = 256;

/// A cluttered room, cut, in which the first element of every 64th patch is brighter than all others.
fn room_with_bright_spots() -> (Scene, PatchMesh, Field) {
    let scene = scenes::cluttered_room(5);
    let mesh = PatchMesh::new(&scene, &MeshSettings { element_size: 0.25, patch_size: 0.5 }).unwrap();
    let mut radiosity = Field::from_values(1, vec![Vec3::ONE; mesh.elements.len()]);
    for patch in mesh.patches.iter().step_by(64) {
        radiosity.at_mut(mesh.members_of(patch)[0].index())[0] *= 50.0;
    }
    (scene, mesh, radiosity)
}

#[test]
fn one_look_tells_how_much_others_would_differ() {
    let (scene, mesh, radiosity) = room_with_bright_spots();
    let tracer = Tracer::new(&scene);
    let mut method = Hemispheres::new(&tracer, &mesh, NUM_RAYS);
    for position in [Vec3::new(0.5, 0.01, 0.5), Vec3::new(2.0, 0.01, 2.5), Vec3::new(3.5, 0.01, 4.0)] {
        let looks: Vec<Viewpoint> = (0..1000).map(|seed| Viewpoint { position, normal: Vec3::Y, seed }).collect();
        let seen =
            map_rows(&mut method, &looks, &|| true, |_, row| irradiance_and_variance(row, &radiosity, NUM_RAYS as f32));
        let (irradiance, told): (Vec<f32>, Vec<f32>) = seen.unwrap().into_iter().unzip();
        let mean = mean(&irradiance);
        let found = irradiance.iter().map(|e| (e - mean).powi(2)).sum::<f32>() / looks.len() as f32;
        let told = self::mean(&told);
        assert!(told / found > 0.5 && told / found < 2.0, "{told} is told of {found} at {position}");
    }
}

fn mean(values: &[f32]) -> f32 {
    values.iter().sum::<f32>() / values.len() as f32
}

/// Irradiance at places on the floor, none borrowed from another, with samples of the given seed.
fn on_the_floor(noise: f32, seed: u32) -> Vec<f32> {
    let (scene, mesh, radiosity) = room_with_bright_spots();
    let tracer = Tracer::new(&scene);
    let mut method = Hemispheres::new(&tracer, &mesh, NUM_RAYS);
    let settings = GatherSettings { tolerance: 1e-4, max_radius: 1.0, noise, contact_reach: 0.1 };
    let site = |i: u32| {
        let place = r2(i, 0);
        let position = Vec3::new(0.1 + 3.8 * place.x, 0.01, 0.1 + 4.8 * place.y);
        Viewpoint { position, normal: Vec3::Y, seed: hash(seed) ^ i }
    };
    let sites: Vec<Viewpoint> = (0..4000).map(site).collect();
    let gathered = Gatherer::new(&mesh, &radiosity, settings).at(&mut method, &sites, &Unwatched).unwrap();
    gathered.indirect.values().iter().map(|irradiance| irradiance.y).collect()
}

#[test]
fn several_looks_take_the_noise_away_and_no_light() {
    let difference = |noise: f32| {
        let (one, other) = (on_the_floor(noise, 1), on_the_floor(noise, 2));
        let squares: Vec<f32> = one.iter().zip(&other).map(|(a, b)| (a - b).powi(2) / (a * b)).collect();
        (mean(&squares).sqrt(), mean(&one))
    };
    let ((noisy, mean_of_noisy), (quiet, mean_of_quiet)) = (difference(f32::INFINITY), difference(0.02));
    assert!(quiet < 0.4 * noisy, "{quiet} is left of {noisy}");
    assert!((mean_of_quiet / mean_of_noisy - 1.0).abs() < 0.01, "{mean_of_noisy} has become {mean_of_quiet}");
}

#[test]
fn the_places_round_it_decide_how_often_a_place_is_looked_from() {
    let site = |x: f32, normal: Vec3| Viewpoint { position: Vec3::new(x, 0.1, 0.1), normal, seed: 0 };
    let mut noise = Noise::new(0.1, 1.0);
    noise.learn(&site(0.2, Vec3::Y), 3.0, 0.05);
    noise.learn(&site(0.4, Vec3::Y), 1.0, 0.27);
    assert_eq!(noise.looks(&site(0.8, Vec3::Y)), 4);
    assert_eq!(noise.looks(&site(1.2, Vec3::Y)), 1, "too far away");
    assert_eq!(noise.looks(&site(0.8, Vec3::X)), 1, "faces another way");
    noise.learn(&site(1.5, Vec3::Y), 2.0, 4.0);
    assert_eq!(noise.looks(&site(1.2, Vec3::Y)), 16, "no more than is worth it");
}

#[test]
fn a_lamp_too_bright_and_too_near_for_its_noise_to_be_a_number_is_looked_at_all_the_same() {
    let mut builder = SceneBuilder::default();
    let white = builder.material(glowing(Vec3::splat(0.7), Vec3::ZERO));
    builder.room(Vec3::ZERO, Vec3::new(3.0, 2.0, 2.5), [white; 6]);
    builder.light(Light::point(Vec3::new(1.0, 1e-4, 1.0), Vec3::splat(1e15)));
    let settings = BakeSettings { element_size: Some(0.4), ..BakeSettings::preset(Quality::Draft) };
    let baked = bake(None, &with_groups(builder.build(), 1), &settings, &Unwatched).unwrap().baked;
    assert!(baked.light.groups[0].indirect.iter().all(|light| light.is_finite() && light.min_element() >= 0.0));
    // The variance of one look is beyond all numbers.
    let site = Viewpoint { position: Vec3::ZERO, normal: Vec3::Y, seed: 0 };
    let mut noise = Noise::new(0.1, 1.0);
    noise.learn(&site, 1e25, f32::INFINITY);
    assert!((1..=16).contains(&noise.looks(&site)));
}
