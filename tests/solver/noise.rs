//! Sampling noise of gathered light: its variance is estimated from one hemisphere, and several hemispheres reduce it.

use glam::Vec3;
use hemicube::bake::{BakeSettings, Quality, bake};
use hemicube::base::progress::Unwatched;
use hemicube::base::sampling::{hash, r2};
use hemicube::form_factor::hemisphere::Hemispheres;
use hemicube::form_factor::{Viewpoint, map_rows};
use hemicube::patch::{MeshSettings, PatchMesh};
use hemicube::radiosity::Field;
use hemicube::radiosity::gather::{FinalGather, FinalGatherSettings, irradiance_and_variance};
use hemicube::scene::{Light, Scene, SceneBuilder};
use hemicube::trace::Tracer;

use crate::support::scenes::{self, glowing, with_groups};

const NUM_RAYS: u32 = 256;

/// Returns a cluttered room and its mesh. The first element of every 64th patch is brighter than all others.
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
fn the_variance_estimated_from_one_hemisphere_is_that_of_many() {
    let (scene, mesh, radiosity) = room_with_bright_spots();
    let tracer = Tracer::new(&scene);
    let mut source = Hemispheres::new(&tracer, &mesh, NUM_RAYS);
    for position in [Vec3::new(0.5, 0.01, 0.5), Vec3::new(2.0, 0.01, 2.5), Vec3::new(3.5, 0.01, 4.0)] {
        let viewpoints: Vec<Viewpoint> = (0..1000).map(|seed| Viewpoint { position, normal: Vec3::Y, seed }).collect();
        let sampled = map_rows(&mut source, &viewpoints, &|| true, |_, row| {
            irradiance_and_variance(row, &radiosity, NUM_RAYS as f32)
        });
        let (irradiance, estimated): (Vec<f32>, Vec<f32>) = sampled.unwrap().into_iter().unzip();
        let mean = mean(&irradiance);
        let actual = irradiance.iter().map(|e| (e - mean).powi(2)).sum::<f32>() / viewpoints.len() as f32;
        let estimated = self::mean(&estimated);
        let ratio = estimated / actual;
        assert!(ratio > 0.5 && ratio < 2.0, "{estimated} is estimated for {actual} at {position}");
    }
}

fn mean(values: &[f32]) -> f32 {
    values.iter().sum::<f32>() / values.len() as f32
}

/// Computes irradiance at viewpoints on the floor, without interpolation, with samples of the given seed.
fn on_the_floor(noise: f32, seed: u32) -> Vec<f32> {
    let (scene, mesh, radiosity) = room_with_bright_spots();
    let tracer = Tracer::new(&scene);
    let mut source = Hemispheres::new(&tracer, &mesh, NUM_RAYS);
    let settings = FinalGatherSettings { tolerance: 1e-4, max_radius: 1.0, noise, near_field_reach: 0.1 };
    let viewpoint = |i: u32| {
        let square = r2(i, 0);
        let position = Vec3::new(0.1 + 3.8 * square.x, 0.01, 0.1 + 4.8 * square.y);
        Viewpoint { position, normal: Vec3::Y, seed: hash(seed) ^ i }
    };
    let viewpoints: Vec<Viewpoint> = (0..4000).map(viewpoint).collect();
    let gathered = FinalGather::new(&mesh, &radiosity, settings).at(&mut source, &viewpoints, &Unwatched).unwrap();
    gathered.indirect.values().iter().map(|irradiance| irradiance.y).collect()
}

#[test]
fn several_hemispheres_reduce_the_noise_without_bias() {
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
fn a_lamp_whose_variance_overflows_bakes_to_finite_light() {
    let mut builder = SceneBuilder::default();
    let white = builder.material(glowing(Vec3::splat(0.7), Vec3::ZERO));
    builder.room(Vec3::ZERO, Vec3::new(3.0, 2.0, 2.5), [white; 6]);
    builder.light(Light::point(Vec3::new(1.0, 1e-4, 1.0), Vec3::splat(1e15)));
    let settings = BakeSettings { element_size: Some(0.4), ..BakeSettings::preset(Quality::Draft) };
    let baked = bake(&with_groups(builder.build(), 1), &settings).unwrap().baked;
    assert!(baked.light.groups[0].indirect.iter().all(|light| light.is_finite() && light.min_element() >= 0.0));
}
