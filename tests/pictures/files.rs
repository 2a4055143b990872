//! Pictures as files, and a room compared with its snapshot.

use std::path::Path;

use glam::Vec3;
use hemicube::base::ids::GroupId;
use hemicube::render::scene::SceneBuffers;
use hemicube::render::{Exposure, PictureRequest, Raster, RenderSettings, ToneMap, draw_picture, tone_map_on_cpu};
use hemicube::scene::{Camera, Material};

use super::stage::{SIZE, draw, four_texels, plain};
use crate::support::device::gpu;
use crate::support::quads::{Quads, paint};
use crate::support::snapshot::assert_snapshot;

#[test]
fn files_contain_the_values_of_the_picture() {
    let Some(picture) = draw(&four_texels(), &plain()) else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let (png, exr) = (folder.path().join("a.png"), folder.path().join("a.EXR"));
    picture.save(&png).expect("written");
    picture.save(&exr).expect("written");
    assert_eq!(Raster::load(&png).expect("read").pixels, Raster::displayed(&picture).pixels);
    assert_eq!(Raster::load(&exr).expect("read"), Raster::radiance(&picture));
    assert_eq!(std::fs::read_dir(folder.path()).expect("listed").count(), 2, "no temporary file is left");
}

#[test]
fn an_error_names_the_file_that_cannot_be_written_or_read() {
    let Some(picture) = draw(&four_texels(), &plain()) else { return };
    let nowhere = Path::new("/no/such/folder/a.png");
    let messages = [picture.save(nowhere).expect_err("no folder"), Raster::load(nowhere).expect_err("no file")];
    for message in messages.map(|error| error.to_string()) {
        assert!(message.contains("/no/such/folder/a.png"), "{message}");
    }
}

/// A box that is open towards the camera, with a red and a green wall, and a lamp whose light decreases with distance.
fn room() -> Quads {
    let mut quads = Quads::with_groups(1);
    let white = quads.material(paint(Vec3::splat(0.75)));
    let red = quads.material(paint(Vec3::new(0.6, 0.06, 0.05)));
    let green = quads.material(paint(Vec3::new(0.12, 0.5, 0.1)));
    let lamp = quads.material(Material { emission: Vec3::new(17.0, 12.0, 4.0), ..paint(Vec3::splat(0.75)) });
    let (x, y, z) = (2.0 * Vec3::X, 2.0 * Vec3::Y, 2.0 * Vec3::Z);
    quads.quad(Vec3::new(-1.0, -1.0, 1.0), x, -z, white);
    quads.quad(Vec3::new(-1.0, 1.0, -1.0), x, z, white);
    quads.quad(Vec3::new(-1.0, -1.0, -1.0), x, y, white);
    quads.quad(Vec3::new(-1.0, -1.0, 1.0), -z, y, red);
    quads.quad(Vec3::new(1.0, -1.0, -1.0), z, y, green);
    quads.quad(Vec3::new(-0.3, 0.99, -0.3), 0.3 * x, 0.3 * z, lamp);
    let light = |p: Vec3| Vec3::new(12.0, 9.0, 5.0) / (0.6 + (p - Vec3::Y).length_squared());
    quads.light(GroupId(0), light, |_| Vec3::splat(0.5));
    quads
}

#[test]
fn a_room_equals_its_snapshot() {
    let Some(gpu) = gpu() else { return };
    let camera = Camera::looking_at("room", Vec3::new(0.3, 0.2, 4.2), Vec3::ZERO, 0.65);
    let scene = SceneBuffers::new(gpu, &room().baked);
    let drawn = draw_picture(gpu, &PictureRequest::new(&scene, &camera, [256; 2], &RenderSettings::default()), 1);
    assert_snapshot("room", &drawn.expect("a picture"));
}

#[test]
fn tone_mapping_on_the_cpu_equals_that_on_the_gpu() {
    // Colours from dark to far beyond white, and a corner without a surface.
    let mut quads = Quads::with_groups(1);
    let material = quads.material(paint(Vec3::new(0.9, 0.6, 0.3)));
    quads.quad(Vec3::new(-1.0, -1.0, 0.0), 1.9 * Vec3::X, 1.7 * Vec3::Y, material);
    quads.light(GroupId(0), |at| Vec3::new(3e3, 1e3, 2e3) * (0.01 + (at.x + 1.0) * (at.y + 1.0)), |_| Vec3::ZERO);
    for exposure in [Exposure::Auto, Exposure::Ev(-9.0), Exposure::Ev(-6.0)] {
        for tone_map in [ToneMap::Neutral, ToneMap::Linear] {
            let settings = RenderSettings { exposure, tone_map, ..RenderSettings::default() };
            let Some(drawn) = draw(&quads, &settings) else { return };
            let developed = tone_map_on_cpu([SIZE; 2], drawn.radiance.clone(), &settings);
            let off = drawn.display.iter().zip(&developed.display).map(|(a, b)| a.abs_diff(*b)).max();
            assert!(off <= Some(1), "{settings:?}: {off:?} steps apart");
        }
    }
}
