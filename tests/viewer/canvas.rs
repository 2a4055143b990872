//! Pictures of the viewer: false colours with their lines, marks over a picture, hidden instances, dimmed light.

use std::f32::consts::PI;

use glam::Vec3;
use hemicube::base::ids::{GroupId, InstanceId};
use hemicube::gpu::Gpu;
use hemicube::gpu::readback::read_texture;
use hemicube::render::scene::SceneBuffers;
use hemicube::render::{
    LuxScale, Mark, Overlay, OverlayPass, Picture, PictureRequest, RenderSettings, Shading, draw_picture, turbo,
};
use wgpu::{CommandEncoderDescriptor, TextureFormat};

use crate::support::device::gpu;
use crate::support::quads::{Quads, paint, square_camera};
use crate::support::screen::screen;

const SIZE: u32 = 64;

fn false_colour(lux_scale: LuxScale) -> RenderSettings {
    RenderSettings { shading: Shading::FalseColour, lux_scale, background: Vec3::ZERO, ..RenderSettings::default() }
}

fn drawn(gpu: &Gpu, quads: &Quads, settings: &RenderSettings) -> Picture {
    let scene = SceneBuffers::new(gpu, &quads.baked);
    draw_picture(gpu, &PictureRequest::new(&scene, &square_camera(), [SIZE; 2], settings), 1).expect("a picture")
}

fn pixel(picture: &Picture, x: u32, y: u32) -> [u8; 3] {
    let at = 4 * (y * picture.width + x) as usize;
    [picture.display[at], picture.display[at + 1], picture.display[at + 2]]
}

#[track_caller]
fn assert_near(found: [u8; 3], expected: [u8; 3], tolerance: u8) {
    assert!((0..3).all(|i| found[i].abs_diff(expected[i]) <= tolerance), "{found:?}, not {expected:?}");
}

#[test]
fn false_colours_match_the_legend_for_any_reflectance() {
    let Some(gpu) = gpu() else { return };
    for (low, high, is_logarithmic) in [(10.0, 1000.0, true), (0.0, 500.0, false)] {
        let scale = LuxScale { low, high, is_logarithmic, num_parts: 0 };
        for place in [0.05, 0.3, 0.62, 0.95] {
            let quads = Quads::square(paint(Vec3::new(0.7, 0.2, 0.1)), Vec3::splat(scale.lux_at(place)));
            let picture = drawn(gpu, &quads, &false_colour(scale));
            assert_near(pixel(&picture, SIZE / 2, SIZE / 2), turbo(place), 3);
        }
    }
}

#[test]
fn lines_lie_at_the_divisions_of_the_scale() {
    let Some(gpu) = gpu() else { return };
    // Illuminance rises linearly from 0 at the left to 200 lx at the right.
    let mut quads = Quads::square(paint(Vec3::ONE), Vec3::ZERO);
    quads.light(GroupId(0), |p| Vec3::splat(100.0 * (p.x + 1.0)), |_| Vec3::ZERO);
    let scale = LuxScale { low: 0.0, high: 200.0, is_logarithmic: false, num_parts: 4 };
    let picture = drawn(gpu, &quads, &false_colour(scale));
    let brightness = |x: u32| pixel(&picture, x, SIZE / 2).iter().map(|&c| u32::from(c)).sum::<u32>();
    for x in [SIZE / 4, SIZE / 2, 3 * SIZE / 4] {
        let on_line = (x - 1..=x).map(brightness).min().expect("two pixels");
        assert!(3 * on_line < 2 * brightness(x + 6), "at {x}: {on_line} beside {}", brightness(x + 6));
    }
    let plain = drawn(gpu, &quads, &false_colour(LuxScale { num_parts: 0, ..scale }));
    assert_near(pixel(&plain, SIZE / 2, SIZE / 2), turbo(0.5), 12);
}

/// Draws `quads` in false colours with an overlay.
fn marked(gpu: &Gpu, quads: &Quads, lines: &[Mark], triangles: &[Mark]) -> Picture {
    let settings = false_colour(LuxScale { num_parts: 0, ..LuxScale::default() });
    let scene = SceneBuffers::new(gpu, &quads.baked);
    let target = screen(gpu, [SIZE; 2], TextureFormat::Rgba8Unorm);
    let request = PictureRequest::new(&scene, &square_camera(), [SIZE; 2], &settings);
    let target_view = target.create_view(&Default::default());
    let mut renderer = hemicube::render::Renderer::new(gpu, TextureFormat::Rgba8Unorm, 1);
    let mut overlay = OverlayPass::new(gpu, TextureFormat::Rgba8Unorm);
    let marks = Overlay::new(gpu, lines, triangles);
    let mut encoder = gpu.device.create_command_encoder(&CommandEncoderDescriptor { label: None });
    renderer.draw(gpu, &mut encoder, &target_view, &request);
    overlay.draw(gpu, &mut encoder, &target_view, &request, &marks);
    gpu.queue.submit([encoder.finish()]);
    let display = read_texture(gpu, &target, 4).expect("read");
    Picture { width: SIZE, height: SIZE, radiance: Vec::new(), display }
}

#[test]
fn marks_are_hidden_behind_surfaces_only() {
    let Some(gpu) = gpu() else { return };
    let quads = Quads::square(paint(Vec3::ONE), Vec3::splat(PI));
    let face = |z: f32| {
        let colour = [10, 200, 30, 255];
        [(-0.5, -0.5), (0.5, -0.5), (0.0, 0.6)].map(|(x, y)| Mark { position: Vec3::new(x, y, z), colour })
    };
    assert_near(pixel(&marked(gpu, &quads, &[], &face(0.0)), SIZE / 2, SIZE / 2), [10, 200, 30], 1);
    let behind = pixel(&marked(gpu, &quads, &[], &face(-0.1)), SIZE / 2, SIZE / 2);
    assert_near(behind, pixel(&marked(gpu, &quads, &[], &[]), SIZE / 2, SIZE / 2), 0);
}

#[test]
fn a_wire_is_one_pixel_wide() {
    let Some(gpu) = gpu() else { return };
    let quads = Quads::square(paint(Vec3::ONE), Vec3::splat(PI));
    let ends = [-1.0, 1.0].map(|x| Mark { position: Vec3::new(x, 0.01, 0.0), colour: [255, 255, 255, 255] });
    let picture = marked(gpu, &quads, &ends, &[]);
    let white = (0..SIZE).filter(|&y| pixel(&picture, SIZE / 3, y) == [255; 3]).count();
    assert_eq!(white, 1);
}

#[test]
fn hidden_instances_are_not_drawn_and_the_others_keep_their_light() {
    let Some(gpu) = gpu() else { return };
    let mut quads = Quads::with_groups(1);
    let white = quads.material(paint(Vec3::ONE));
    quads.quad(Vec3::new(-1.0, -1.0, 0.0), Vec3::X, 2.0 * Vec3::Y, white);
    quads.quad(Vec3::new(0.0, -1.0, 0.0), Vec3::X, 2.0 * Vec3::Y, white);
    quads.light(GroupId(0), |_| Vec3::splat(100.0), |_| Vec3::ZERO);
    quads.baked.scene.triangles[2..].iter_mut().for_each(|triangle| triangle.instance = InstanceId(1));
    let all = SceneBuffers::new(gpu, &quads.baked);
    let part = all.part(gpu, &quads.baked.scene, |triangle| triangle.instance != InstanceId(1));
    let settings = false_colour(LuxScale { num_parts: 0, ..LuxScale::default() });
    let picture = |scene: &SceneBuffers| {
        draw_picture(gpu, &PictureRequest::new(scene, &square_camera(), [SIZE; 2], &settings), 1).expect("drawn")
    };
    let (whole, half) = (picture(&all), picture(&part));
    assert_eq!(pixel(&half, SIZE / 4, SIZE / 2), pixel(&whole, SIZE / 4, SIZE / 2));
    assert!(pixel(&half, 3 * SIZE / 4, SIZE / 2).iter().all(|&channel| channel < 3));
    // New light is uploaded for both.
    let mut light = quads.baked.light.clone();
    light.groups[0].direct.fill(Vec3::splat(500.0));
    all.set_light(gpu, &light);
    assert_ne!(pixel(&picture(&part), SIZE / 4, SIZE / 2), pixel(&half, SIZE / 4, SIZE / 2));
}
