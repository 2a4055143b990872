//! Conversion of radiance to display colours: exposure, metering, dither, background.

use std::f32::consts::PI;

use glam::Vec3;
use hemicube::base::ids::GroupId;
use hemicube::gpu::Gpu;
use hemicube::gpu::readback::read_texture;
use hemicube::render::scene::SceneBuffers;
use hemicube::render::{Exposure, Picture, PictureRequest, Raster, RenderSettings, Renderer, ToneMap, picture};
use hemicube::scene::Material;
use wgpu::{CommandEncoderDescriptor, TextureFormat};

use super::stage::{SIZE, display_at, draw, four_texels, plain};
use crate::support::device::gpu;
use crate::support::quads::{Quads, paint, square_camera};
use crate::support::screen::screen;

#[test]
fn exposure_is_a_power_of_two_and_the_display_is_srgb() {
    let quads = Quads::square(paint(Vec3::ONE), Vec3::splat(PI / 8.0));
    let shown =
        |ev| draw(&quads, &RenderSettings { exposure: Exposure::Ev(ev), ..plain() }).map(|p| display_at(&p, 20, 30)[0]);
    let Some(dark) = shown(0.0) else { return };
    // sRGB of 1/8, 1/4 and 1.
    assert!(dark.abs_diff(99) <= 1 && shown(1.0).expect("a GPU").abs_diff(137) <= 1, "{dark}");
    assert_eq!(shown(3.0), Some(255));
}

#[test]
fn metering_does_not_depend_on_the_strength_of_the_light() {
    let settings = RenderSettings { exposure: Exposure::Auto, ..plain() };
    let shown = |light| draw(&Quads::square(paint(Vec3::ONE), Vec3::splat(light)), &settings);
    let Some(dim) = shown(0.01) else { return };
    let bright = shown(30_000.0).expect("a GPU");
    // Middle grey is 0.2 of white within half a histogram bin: sRGB 124.
    for picture in [&dim, &bright] {
        let level = display_at(picture, 30, 30)[0];
        assert!(level.abs_diff(124) <= 4, "{level}");
    }
}

#[test]
fn metering_protects_highlights_and_ignores_the_background() {
    // A quarter of the picture is a thousand times brighter than the rest, and the background is large and black.
    let mut quads = Quads::with_groups(1);
    let white = quads.material(paint(Vec3::ONE));
    quads.quad(Vec3::new(-0.5, -0.5, 0.0), Vec3::X, Vec3::Y, white);
    quads.quad(Vec3::new(-0.5, -0.5, 0.1), 0.5 * Vec3::X, 0.5 * Vec3::Y, white);
    quads.light(GroupId(0), |p| Vec3::splat(if p.z > 0.05 { 1000.0 } else { 1.0 }), |_| Vec3::ZERO);
    let Some(picture) = draw(&quads, &RenderSettings { tone_map: ToneMap::Neutral, ..RenderSettings::default() })
    else {
        return;
    };
    let bright = display_at(&picture, 24, 40)[0];
    assert!(bright > 235 && bright < 253, "{bright}");
    assert!(display_at(&picture, 40, 24)[0] > 2);
}

#[test]
fn dithering_hides_steps_and_keeps_values_that_are_whole_steps() {
    let mut quads = Quads::square(paint(Vec3::ONE), Vec3::ZERO);
    quads.light(GroupId(0), |p| Vec3::splat(PI * (0.20 + 0.005 * p.x)), |_| Vec3::ZERO);
    let Some(ramp) = draw(&quads, &plain()) else { return };
    let changes =
        |picture: &Picture| (1..SIZE).filter(|&x| display_at(picture, x, 9) != display_at(picture, x - 1, 9)).count();
    assert!(changes(&ramp) > 8, "{}", changes(&ramp));
    let white = Material { emission: Vec3::ONE, ..paint(Vec3::ONE) };
    let white = draw(&Quads::square(white, Vec3::ZERO), &plain()).expect("a GPU");
    assert!(white.display.iter().all(|&byte| byte == 255));
}

#[test]
fn the_background_is_a_display_colour_without_radiance() {
    let settings = RenderSettings { background: Vec3::new(1.0, 0.0, 1.0), exposure: Exposure::Ev(-8.0), ..plain() };
    let Some(picture) = draw(&Quads::with_groups(1), &settings) else { return };
    assert_eq!(display_at(&picture, 5, 5), [255, 0, 255]);
    assert!(picture.radiance.iter().all(|pixel| pixel == &[0.0; 4]));
}

#[test]
fn impossible_sizes_are_refused() {
    let Some(gpu) = gpu() else { return };
    let quads = Quads::square(paint(Vec3::ONE), Vec3::ONE);
    for size in [[0, 10], [10, u32::MAX]] {
        let error = picture(gpu, &quads.baked, &square_camera(), size, &plain()).expect_err("no such picture");
        assert!(error.to_string().contains(&size[1].to_string()), "{error}");
    }
}

#[test]
fn edges_of_lamps_are_smooth_on_the_display() {
    let mut quads = Quads::with_groups(1);
    let lamp = quads.material(Material { emission: Vec3::splat(100.0), ..paint(Vec3::ZERO) });
    quads.quad(Vec3::new(-0.7, -0.5, 0.0), Vec3::new(1.0, 0.3, 0.0), Vec3::new(-0.3, 1.0, 0.0), lamp);
    quads.light(GroupId(0), |_| Vec3::ZERO, |_| Vec3::ZERO);
    let Some(gpu) = gpu() else { return };
    let picture = picture(gpu, &quads.baked, &square_camera(), [SIZE; 2], &plain()).expect("a picture");
    let shown = Raster::displayed(&picture);
    let edges: Vec<_> = (0..shown.pixels.len()).filter(|&i| (0.1..0.9).contains(&picture.radiance[i][3])).collect();
    assert!(edges.len() > 50, "{}", edges.len());
    for i in edges {
        assert!(
            (shown.pixels[i].x - picture.radiance[i][3]).abs() < 0.01,
            "{} {:?}",
            shown.pixels[i],
            picture.radiance[i]
        );
    }
}

#[test]
fn a_target_that_encodes_srgb_holds_the_same_colours() {
    let Some(gpu) = gpu() else { return };
    let quads = four_texels();
    let [plain_target, encoding_target] =
        [TextureFormat::Rgba8Unorm, TextureFormat::Rgba8UnormSrgb].map(|format| draw_two_into(gpu, format, &quads));
    for (a, b) in plain_target.iter().zip(&encoding_target) {
        assert!(a.abs_diff(*b) <= 1, "{a} {b}");
    }
}

#[test]
fn two_pictures_in_one_submission_keep_their_own_settings() {
    let Some(gpu) = gpu() else { return };
    let bytes = draw_two_into(gpu, TextureFormat::Rgba8Unorm, &four_texels());
    let (first, second) = bytes.split_at(bytes.len() / 2);
    assert_eq!(&first[..3], [255, 0, 0]);
    assert!(second[0].abs_diff(137) <= 1, "a quarter of the first: {}", second[0]);
}

/// Returns the bytes of two pictures that are drawn in one submission, the second two stops darker.
fn draw_two_into(gpu: &Gpu, format: TextureFormat, quads: &Quads) -> Vec<u8> {
    let scene = SceneBuffers::new(gpu, &quads.baked);
    let mut renderer = Renderer::new(gpu, format, 1);
    let mut encoder = gpu.device.create_command_encoder(&CommandEncoderDescriptor::default());
    let targets = [0.0, -2.0].map(|ev| {
        let target = screen(gpu, [SIZE; 2], format);
        let settings = RenderSettings { exposure: Exposure::Ev(ev), ..plain() };
        let request = PictureRequest::new(&scene, &square_camera(), [SIZE; 2], &settings);
        renderer.draw(gpu, &mut encoder, &target.create_view(&Default::default()), &request);
        target
    });
    gpu.queue.submit([encoder.finish()]);
    targets.iter().flat_map(|target| read_texture(gpu, target, 4).expect("a picture")).collect()
}
