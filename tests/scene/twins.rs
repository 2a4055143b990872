//! Files with extensions look like their twins, the same scenes in plain glTF.
//!
//! `tests/interop/make_files.mjs` writes them with third-party encoders.

use std::path::{Path, PathBuf};

use glam::Vec3;
use hemicube::baked::{BakedScene, VertexLight};
use hemicube::render::{Exposure, Raster, RenderSettings, ToneMap, compare, picture};
use hemicube::scene::Scene;
use hemicube::scene::gltf::{LoadOptions, from_slice, load, load_with};

use crate::support::device::gpu;

const SIZE: [u32; 2] = [96, 96];

/// Each file with its twin, the tolerated relative error of its picture, and the cause of the error.
const TWINS: [(&str, &str, f64); 15] = [
    ("bytes", "plain", 0.004),             // colours in 256 steps
    ("words", "plain", 0.001),             // colours in 65,536 steps
    ("sparse", "plain", 0.0),              // nothing
    ("second_uv", "plain", 0.0),           // nothing
    ("two_scenes", "plain", 0.0),          // nothing
    ("morph", "plain", 1e-3),              // rounding of positions
    ("skin", "plain", 1e-3),               // rounding of positions
    ("instancing", "several_plain", 1e-3), // rounding of positions
    ("quantized", "plain", 0.02),          // positions in 14 bits, texture coordinates in 12
    ("meshopt", "plain", 0.02),            // the same
    ("meshopt_filters", "plain", 0.02),    // the same
    ("draco", "plain", 0.02),              // positions in 14 bits, texture coordinates in 12
    ("draco_sequential", "plain", 0.02),   // the same
    ("webp", "plain", 0.03),               // loss of the picture
    ("basisu_uastc", "plain", 0.03),       // loss of the picture
];

fn path(name: &str) -> PathBuf {
    Path::new("tests/files").join(name).with_extension("glb")
}

fn scene(name: &str) -> Scene {
    load(&path(name)).unwrap()
}

/// Draws a scene in uniform ambient light, which shows shape, colours and textures.
fn shown(scene: Scene) -> Option<Raster> {
    let camera = scene.cameras[0].clone();
    let light = VertexLight::dark(0, scene.vertices.len());
    let baked = BakedScene::new(scene, light);
    let settings = RenderSettings {
        ambient: Vec3::splat(0.5),
        exposure: Exposure::Ev(0.0),
        tone_map: ToneMap::Linear,
        background: Vec3::ZERO,
        ..RenderSettings::default()
    };
    let picture = picture(gpu()?, &baked, &camera, SIZE, &settings).unwrap();
    Some(Raster::of(&picture, hemicube::render::FileKind::Radiance))
}

/// Computes the relative error between the pictures of two scenes; `None` without a GPU.
fn error(one: Scene, other: Scene) -> Option<f64> {
    Some(f64::from(compare(&shown(one)?, &shown(other)?).unwrap().relative_rmse))
}

#[test]
fn every_file_looks_like_its_plain_twin() {
    for (name, twin, tolerance) in TWINS {
        let Some(error) = error(scene(name), scene(twin)) else { return };
        println!("{name}: {error:.5}");
        assert!(error <= tolerance, "{name} differs from {twin} by {error}");
    }
}

/// ETC1S compresses strongly; the error stays small to the eye.
#[test]
fn etc1s_looks_like_its_plain_twin() {
    let Some(error) = error(scene("basisu_etc1s"), scene("plain")) else { return };
    assert!(error <= 0.1, "{error}");
}

#[test]
fn the_comparison_detects_a_different_shape_or_texture() {
    let mut bare = scene("plain");
    bare.materials[0].base_colour_texture = None;
    let mut thin = scene("plain");
    thin.vertices.iter_mut().for_each(|vertex| vertex.position.y *= 0.95);
    for other in [bare, thin] {
        let Some(error) = error(other, scene("plain")) else { return };
        assert!(error > 0.1, "{error}");
    }
}

#[test]
fn the_geometry_equals_that_of_the_twin() {
    for (name, twin, _) in TWINS {
        let (scene, twin) = (scene(name), scene(twin));
        assert_eq!(scene.triangles.len(), twin.triangles.len(), "{name}");
        let share = (scene.area() / twin.area() - 1.0).abs();
        assert!(share < 2e-3, "{name}: the area is off by {share}");
        assert!(scene.notes.is_empty(), "{name}: {:?}", scene.notes);
    }
}

#[test]
fn a_uniform_photometric_light_equals_a_point_light() {
    let [point, photometric] = [scene("point_light"), scene("photometric_light")].map(|scene| scene.lights[0].clone());
    assert!(point.profile.is_none() && photometric.profile.is_some());
    for at in [Vec3::ZERO, Vec3::new(1.0, 9.0, 2.0), Vec3::new(-4.0, 2.0, 7.0)] {
        let [a, b] = [&point, &photometric].map(|light| light.arrival(at).irradiance);
        assert!((a - b).length() < 1e-5 * a.length(), "{a} and {b} at {at}");
    }
}

/// KHR_meshopt_compression has the same JSON as EXT_meshopt_compression.
#[test]
fn khr_meshopt_compression_reads_as_ext() {
    let bytes = std::fs::read(path("meshopt")).unwrap();
    let text = String::from_utf8_lossy(&bytes[20..]);
    let length = text.find('\0').unwrap_or(text.len()).min(8000);
    let json_end = 20 + length.min(u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize);
    let json = String::from_utf8(bytes[20..json_end].to_vec()).unwrap();
    let renamed = json.replace("EXT_meshopt_compression", "KHR_meshopt_compression");
    assert_eq!((json.len(), renamed == json), (renamed.len(), false));
    let file = [&bytes[..20], renamed.as_bytes(), &bytes[json_end..]].concat();
    let scene = from_slice("renamed", &file).unwrap();
    assert_eq!(scene.vertices, self::scene("meshopt").vertices);
}

#[test]
fn a_variant_is_chosen_by_name() {
    let chosen = LoadOptions { variant: Some("hills".to_owned()) };
    let hills = load_with(&path("variants"), &chosen).unwrap();
    assert_eq!(hills.variants, ["hills"]);
    let Some(same) = error(hills, scene("plain")) else { return };
    let bare = error(scene("variants"), scene("plain")).unwrap();
    assert!(same == 0.0 && bare > 0.5, "{same} {bare}");
}

#[test]
fn a_scene_is_chosen_by_name() {
    assert!(load(Path::new("tests/files/two_scenes.glb#empty")).unwrap().triangles.is_empty());
}
