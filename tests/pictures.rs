//! Pictures: radiance of known surfaces, texture reading, alpha, faces, exposure.

use std::f32::consts::PI;
use std::path::Path;

use glam::{Affine2, Vec2, Vec3};
use hemicube::base::ids::GroupId;
use hemicube::gpu::readback::read_texture;
use hemicube::gpu::{Gpu, SceneBuffers};
use hemicube::render::{
    Exposure, Look, Picture, Raster, Renderer, Shading, ToneMap, View, develop, picture, picture_of,
};
use hemicube::scene::{AlphaMode, Camera, Material};
use wgpu::{CommandEncoderDescriptor, Extent3d, TextureDescriptor, TextureDimension, TextureFormat, TextureUsages};

use crate::support::device::gpu;
use crate::support::quads::{Quads, paint, slot, square_camera, texture};
use crate::support::snapshot::assert_snapshot;

const SIZE: u32 = 64;

/// Radiance shown as it is.
fn plain() -> Look {
    Look {
        exposure: Exposure::Ev(0.0),
        tone_map: ToneMap::Linear,
        background: Vec3::ZERO,
        metal_as_diffuse: false,
        ..Look::default()
    }
}

/// The square seen face on, without multisampling.
fn draw(quads: &Quads, look: &Look) -> Option<Picture> {
    let gpu = gpu()?;
    let scene = SceneBuffers::new(gpu, &quads.baked);
    Some(picture_of(gpu, &scene, &square_camera(), [SIZE; 2], look, 1).expect("a picture"))
}

fn radiance_at(picture: &Picture, x: u32, y: u32) -> Vec3 {
    let [r, g, b, _] = picture.radiance[(y * picture.width + x) as usize];
    Vec3::new(r, g, b)
}

fn display_at(picture: &Picture, x: u32, y: u32) -> [u8; 3] {
    let at = 4 * (y * picture.width + x) as usize;
    [picture.display[at], picture.display[at + 1], picture.display[at + 2]]
}

/// Radiance in the middle of the square.
fn centre(quads: &Quads, look: &Look) -> Option<Vec3> {
    draw(quads, look).map(|picture| radiance_at(&picture, SIZE / 2, SIZE / 2))
}

#[track_caller]
fn assert_close(found: Vec3, expected: Vec3) {
    assert_within(1e-3, found, expected);
}

/// Equal to a share of the largest channel.
#[track_caller]
fn assert_within(tolerance: f32, found: Vec3, expected: Vec3) {
    let largest = expected.abs().max_element().max(1e-3);
    assert!((found - expected).abs().max_element() <= tolerance * largest, "{found}, not {expected}");
}

#[test]
fn a_surface_sends_reflectance_times_irradiance_over_pi_plus_emission() {
    let grey = Quads::square(paint(Vec3::splat(0.5)), Vec3::splat(PI));
    let lamp = Quads::square(
        Material { emission: Vec3::new(3.0, 2.0, 1.0), ..paint(Vec3::new(0.2, 0.4, 0.8)) },
        Vec3::new(PI, 2.0 * PI, PI),
    );
    let Some(radiance) = centre(&grey, &plain()) else { return };
    assert_close(radiance, Vec3::splat(0.5));
    assert_close(centre(&lamp, &plain()).expect("a GPU"), Vec3::new(3.2, 2.8, 1.8));
}

#[test]
fn all_of_a_square_is_covered_and_nothing_beyond() {
    let quads = Quads::square(paint(Vec3::ONE), Vec3::splat(PI));
    let Some(gpu) = gpu() else { return };
    let mut wide = square_camera();
    wide.projection = hemicube::scene::Projection::Orthographic { half_height: 2.0 };
    let picture = picture(gpu, &quads.baked, &wide, [SIZE; 2], &plain()).expect("a picture");
    let covered = picture.radiance.iter().filter(|pixel| pixel[3] == 1.0).count();
    assert_eq!(covered as u32, SIZE * SIZE / 4);
    assert!(picture.radiance.iter().all(|pixel| pixel[3] == 1.0 || pixel == &[0.0; 4]));
}

#[test]
fn very_bright_lamps_keep_their_radiance() {
    let sun = Quads::square(Material { emission: Vec3::splat(1.6e9), ..paint(Vec3::ONE) }, Vec3::ZERO);
    let Some(radiance) = centre(&sun, &plain()) else { return };
    assert_close(radiance, Vec3::splat(1.6e9));
}

/// Two groups with direct and indirect light, all different.
fn four_lights() -> Quads {
    let mut quads = Quads::with_groups(2);
    let white = quads.material(paint(Vec3::ONE));
    quads.quad(Vec3::new(-1.0, -1.0, 0.0), 2.0 * Vec3::X, 2.0 * Vec3::Y, white);
    quads.light(GroupId(0), |_| Vec3::splat(1.0 * PI), |_| Vec3::splat(2.0 * PI));
    quads.light(GroupId(1), |_| Vec3::splat(4.0 * PI), |_| Vec3::splat(8.0 * PI));
    quads
}

#[test]
fn the_picture_is_linear_in_every_part_of_the_light() {
    let quads = four_lights();
    let Some(all) = centre(&quads, &plain()) else { return };
    assert_close(all, Vec3::splat(15.0));
    let shown = |look: Look| centre(&quads, &look).expect("a GPU");
    assert_close(shown(Look { direct: 0.0, ..plain() }), Vec3::splat(10.0));
    assert_close(shown(Look { indirect: 0.0, ..plain() }), Vec3::splat(5.0));
    assert_close(shown(Look { group_weights: vec![Vec3::ZERO], ..plain() }), Vec3::splat(12.0));
    let red_and_double = vec![Vec3::X, Vec3::splat(2.0)];
    assert_close(shown(Look { group_weights: red_and_double, ..plain() }), Vec3::new(27.0, 24.0, 24.0));
    let ambient = Vec3::new(0.0, 1.0, 2.0);
    assert_close(shown(Look { direct: 0.0, indirect: 0.0, ambient, ..plain() }), ambient);
}

#[test]
fn a_dimmed_group_dims_the_glow_of_its_lamps() {
    let lamp = Material { emission: Vec3::ONE, group: Some(GroupId(0)), ..paint(Vec3::ONE) };
    let quads = Quads::square(lamp, Vec3::ZERO);
    let look = Look { group_weights: vec![Vec3::new(0.5, 0.25, 0.0)], ..plain() };
    let Some(radiance) = centre(&quads, &look) else { return };
    assert_close(radiance, Vec3::new(0.5, 0.25, 0.0));
}

#[test]
fn irradiance_is_interpolated_between_vertices() {
    let mut quads = Quads::square(paint(Vec3::ONE), Vec3::ZERO);
    quads.light(GroupId(0), |p| Vec3::splat(PI * (1.0 + p.x)), |_| Vec3::ZERO);
    let Some(picture) = draw(&quads, &plain()) else { return };
    for x in [0, 10, 40, 63] {
        assert_close(radiance_at(&picture, x, 20), Vec3::splat((x as f32 + 0.5) / 32.0));
    }
}

#[test]
fn metals_are_black_unless_shown_as_diffuse() {
    let metal = Material { metallic: 1.0, ..paint(Vec3::new(0.9, 0.6, 0.3)) };
    let quads = Quads::square(metal, Vec3::splat(PI));
    let Some(black) = centre(&quads, &plain()) else { return };
    assert_close(black, Vec3::ZERO);
    let shown = centre(&quads, &Look { metal_as_diffuse: true, ..plain() }).expect("a GPU");
    assert_close(shown, Vec3::new(0.9, 0.6, 0.3));
}

#[test]
fn unlit_surfaces_show_their_base_colour() {
    let sign = Material { unlit: true, ..paint(Vec3::new(0.1, 0.5, 0.9)) };
    let Some(radiance) = centre(&Quads::square(sign, Vec3::splat(100.0)), &plain()) else { return };
    assert_close(radiance, Vec3::new(0.1, 0.5, 0.9));
}

/// The square with a texture of 2 x 2 texels: red green / blue white.
fn four_texels() -> Quads {
    let texels = [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [255, 255, 255, 255]];
    let mut quads = Quads::square(Material { base_colour_texture: Some(slot(0)), ..paint(Vec3::ONE) }, Vec3::splat(PI));
    quads.baked.scene.textures.push(texture(2, &texels));
    quads
}

/// Display colours of the four quarters, row by row.
fn quarters(picture: &Picture) -> [[u8; 3]; 4] {
    [(16, 16), (48, 16), (16, 48), (48, 48)].map(|(x, y)| display_at(picture, x, y))
}

#[test]
fn textures_stand_upright() {
    let Some(picture) = draw(&four_texels(), &plain()) else { return };
    assert_eq!(quarters(&picture), [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 255]]);
}

#[test]
fn texture_transform_and_coordinate_set_are_followed() {
    let mut quads = four_texels();
    let scene = &mut quads.baked.scene;
    for vertex in &mut scene.vertices {
        vertex.uv[0] = Vec2::ZERO;
    }
    // Half a turn about the middle on the second set swaps opposite texels.
    let mut turned = slot(0);
    turned.uv_set = 1;
    turned.transform = Affine2::from_translation(Vec2::ONE) * Affine2::from_angle(PI);
    scene.materials[0].base_colour_texture = Some(turned);
    let Some(picture) = draw(&quads, &plain()) else { return };
    assert_eq!(quarters(&picture), [[255, 255, 255], [0, 0, 255], [0, 255, 0], [255, 0, 0]]);
}

#[test]
fn textures_agree_with_the_transport_of_the_same_material() {
    let mut quads = four_texels();
    let scene = &mut quads.baked.scene;
    scene.textures[0] = texture(2, &[[200, 30, 90, 255], [10, 128, 250, 255], [60, 60, 61, 255], [1, 2, 3, 255]]);
    scene.textures.push(texture(1, &[[0, 0, 77, 255]]));
    scene.materials[0].metallic = 0.8;
    scene.materials[0].metallic_roughness_texture = Some(slot(1));
    scene.materials[0].emission = Vec3::splat(0.3);
    scene.materials[0].emissive_texture = Some(slot(0));
    let Some(picture) = draw(&quads, &plain()) else { return };
    let scene = &quads.baked.scene;
    for (x, y, uv) in [(16, 16, [0.25, 0.25]), (48, 16, [0.75, 0.25]), (16, 48, [0.25, 0.75])] {
        let transport = scene.materials[0].at(&scene.textures, [uv.into(); 2], glam::Vec4::ONE);
        // The software driver decodes sRGB by a polynomial that is off by a quarter of a percent.
        assert_within(5e-3, radiance_at(&picture, x, y), transport.reflectance + transport.emission);
    }
}

#[test]
fn fine_textures_average_in_linear_light() {
    let mut quads = Quads::square(Material { base_colour_texture: Some(slot(0)), ..paint(Vec3::ONE) }, Vec3::splat(PI));
    let board: Vec<[u8; 4]> = (0..256 * 256).map(|i| [if (i + i / 256) % 2 == 0 { 255 } else { 0 }; 4]).collect();
    quads.baked.scene.textures.push(texture(256, &board));
    let Some(radiance) = centre(&quads, &plain()) else { return };
    assert!((radiance - Vec3::splat(0.5)).abs().max_element() < 5e-3, "{radiance}");
}

/// A white square with a hole in its upper left quarter, before a red wall.
fn window(alpha_mode: AlphaMode, alpha: u8) -> Quads {
    let mut quads = Quads::with_groups(1);
    let solid = [255; 4];
    quads.baked.scene.textures.push(texture(2, &[[255, 255, 255, alpha], solid, solid, solid]));
    let pane = quads.material(Material { base_colour_texture: Some(slot(0)), alpha_mode, ..paint(Vec3::ONE) });
    let wall = quads.material(paint(Vec3::X));
    quads.quad(Vec3::new(-1.0, -1.0, 0.0), 2.0 * Vec3::X, 2.0 * Vec3::Y, pane);
    quads.quad(Vec3::new(-1.0, -1.0, -1.0), 2.0 * Vec3::X, 2.0 * Vec3::Y, wall);
    quads.light(GroupId(0), |_| Vec3::splat(PI), |_| Vec3::ZERO);
    quads
}

#[test]
fn masks_have_holes_with_and_without_multisampling() {
    let quads = window(AlphaMode::Mask { cutoff: 0.5 }, 100);
    let Some(gpu) = gpu() else { return };
    for samples in [1, 4] {
        let scene = SceneBuffers::new(gpu, &quads.baked);
        let drawn = picture_of(gpu, &scene, &square_camera(), [SIZE; 2], &plain(), samples);
        let white = [255; 3];
        assert_eq!(quarters(&drawn.expect("a picture")), [[255, 0, 0], white, white, white], "{samples} samples");
    }
}

#[test]
fn blended_surfaces_let_the_rest_through() {
    let Some(picture) = draw(&window(AlphaMode::Blend, 51), &plain()) else { return };
    assert_close(radiance_at(&picture, 16, 16), Vec3::new(1.0, 0.2, 0.2));
    assert_close(radiance_at(&picture, 48, 16), Vec3::ONE);
}

#[test]
fn opaque_surfaces_ignore_alpha() {
    let Some(picture) = draw(&window(AlphaMode::Opaque, 0), &plain()) else { return };
    assert_close(radiance_at(&picture, 16, 16), Vec3::ONE);
}

/// The square seen from behind.
fn from_behind(material: Material) -> Quads {
    let mut quads = Quads::with_groups(1);
    let material = quads.material(material);
    quads.quad(Vec3::new(1.0, -1.0, 0.0), -2.0 * Vec3::X, 2.0 * Vec3::Y, material);
    quads.light(GroupId(0), |_| Vec3::splat(PI), |_| Vec3::ZERO);
    quads
}

/// Radiance and coverage in the middle.
fn middle(quads: &Quads, look: &Look) -> Option<[f32; 2]> {
    let picture = draw(quads, look)?;
    let [r, _, _, a] = picture.radiance[(SIZE / 2 * SIZE + SIZE / 2) as usize];
    Some([r, a])
}

#[test]
fn backs_are_invisible_or_black_or_a_second_face() {
    let single = from_behind(paint(Vec3::ONE));
    let double = from_behind(Material { double_sided: true, ..paint(Vec3::ONE) });
    let solid = Look { cull_back: false, ..plain() };
    let Some(culled) = middle(&single, &plain()) else { return };
    assert_eq!(culled, [0.0, 0.0]);
    assert_eq!(middle(&single, &solid).expect("a GPU"), [0.0, 1.0]);
    assert_eq!(middle(&double, &plain()).expect("a GPU"), [1.0, 1.0]);
}

#[test]
fn baked_twins_are_seen_each_from_its_side() {
    // The front twin looks away and is lit ten times as much.
    let mut quads = from_behind(Material { double_sided: true, ..paint(Vec3::ONE) });
    quads.quad(Vec3::new(-1.0, -1.0, 0.0), 2.0 * Vec3::X, 2.0 * Vec3::Y, hemicube::base::ids::MaterialId(0));
    for triangle in &mut quads.baked.scene.triangles[2..] {
        triangle.is_back_side = true;
    }
    quads.light(GroupId(0), |_| Vec3::splat(PI), |_| Vec3::ZERO);
    for lit in &mut quads.baked.light.groups[0].direct[..4] {
        *lit *= 10.0;
    }
    let solid = Look { cull_back: false, ..plain() };
    let Some(picture) = draw(&quads, &solid) else { return };
    assert!(picture.radiance.iter().all(|pixel| (pixel[0] - 1.0).abs() < 1e-3));
}

#[test]
fn exposure_is_a_power_of_two_and_the_display_is_srgb() {
    let quads = Quads::square(paint(Vec3::ONE), Vec3::splat(PI / 8.0));
    let shown = |ev| draw(&quads, &Look { exposure: Exposure::Ev(ev), ..plain() }).map(|p| display_at(&p, 20, 30)[0]);
    let Some(dark) = shown(0.0) else { return };
    // sRGB of 1/8, 1/4 and 1.
    assert!(dark.abs_diff(99) <= 1 && shown(1.0).expect("a GPU").abs_diff(137) <= 1, "{dark}");
    assert_eq!(shown(3.0), Some(255));
}

#[test]
fn metering_does_not_depend_on_the_strength_of_the_light() {
    let look = Look { exposure: Exposure::Auto, ..plain() };
    let shown = |light| draw(&Quads::square(paint(Vec3::ONE), Vec3::splat(light)), &look);
    let Some(dim) = shown(0.01) else { return };
    let bright = shown(30_000.0).expect("a GPU");
    // Middle grey is 0.2 of white, within half a histogram bin: sRGB 124.
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
    let Some(picture) = draw(&quads, &Look { tone_map: ToneMap::Neutral, ..Look::default() }) else { return };
    let bright = display_at(&picture, 24, 40)[0];
    assert!(bright > 235 && bright < 253, "{bright}");
    assert!(display_at(&picture, 40, 24)[0] > 2);
}

#[test]
fn dithering_hides_steps_but_leaves_whole_steps_alone() {
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
fn albedo_and_normals_are_shown_without_light() {
    let quads = Quads::square(paint(Vec3::new(0.5, 0.25, 0.0)), Vec3::ZERO);
    let shown = |shading| draw(&quads, &Look { shading, ..Look::default() }).map(|p| display_at(&p, 30, 30));
    let Some(albedo) = shown(Shading::Albedo) else { return };
    assert_eq!(albedo, [188, 137, 0]);
    assert_eq!(shown(Shading::Normals), Some([188, 188, 255]));
    let lit = Quads::square(paint(Vec3::new(0.5, 0.25, 0.0)), Vec3::splat(PI));
    let light_alone = Look { shading: Shading::IrradianceOnly, ..plain() };
    assert_close(centre(&lit, &light_alone).expect("a GPU"), Vec3::ONE);
}

#[test]
fn background_is_a_display_colour_and_sends_no_radiance() {
    let look = Look { background: Vec3::new(1.0, 0.0, 1.0), exposure: Exposure::Ev(-8.0), ..plain() };
    let Some(picture) = draw(&Quads::with_groups(1), &look) else { return };
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
fn a_target_that_encodes_srgb_shows_the_same() {
    let Some(gpu) = gpu() else { return };
    let quads = four_texels();
    let [plain_target, encoding_target] =
        [TextureFormat::Rgba8Unorm, TextureFormat::Rgba8UnormSrgb].map(|format| draw_two_into(gpu, format, &quads));
    for (a, b) in plain_target.iter().zip(&encoding_target) {
        assert!(a.abs_diff(*b) <= 1, "{a} {b}");
    }
}

#[test]
fn two_pictures_in_one_submission_keep_their_own_look() {
    let Some(gpu) = gpu() else { return };
    let bytes = draw_two_into(gpu, TextureFormat::Rgba8Unorm, &four_texels());
    let (first, second) = bytes.split_at(bytes.len() / 2);
    assert_eq!(&first[..3], [255, 0, 0]);
    assert!(second[0].abs_diff(137) <= 1, "a quarter of the first: {}", second[0]);
}

/// Bytes of two pictures drawn in one submission, the second two stops darker.
fn draw_two_into(gpu: &Gpu, format: TextureFormat, quads: &Quads) -> Vec<u8> {
    let scene = SceneBuffers::new(gpu, &quads.baked);
    let mut renderer = Renderer::new(gpu, format, 1);
    let view = View::from_camera(&square_camera(), 1.0);
    let mut encoder = gpu.device.create_command_encoder(&CommandEncoderDescriptor::default());
    let targets = [0.0, -2.0].map(|ev| {
        let target = gpu.device.create_texture(&TextureDescriptor {
            label: None,
            size: Extent3d { width: SIZE, height: SIZE, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: TextureDimension::D2,
            format,
            usage: TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let look = Look { exposure: Exposure::Ev(ev), ..plain() };
        renderer.draw(gpu, &mut encoder, &target.create_view(&Default::default()), [SIZE; 2], &scene, &view, &look);
        target
    });
    gpu.queue.submit([encoder.finish()]);
    targets.iter().flat_map(|target| read_texture(gpu, target, 4).expect("a picture")).collect()
}

#[test]
fn light_can_be_replaced_on_the_device() {
    let Some(gpu) = gpu() else { return };
    let mut quads = Quads::square(paint(Vec3::ONE), Vec3::ZERO);
    let scene = SceneBuffers::new(gpu, &quads.baked);
    quads.light(GroupId(0), |_| Vec3::splat(PI), |_| Vec3::splat(PI));
    scene.set_light(gpu, &quads.baked.light);
    let replaced = picture_of(gpu, &scene, &square_camera(), [SIZE; 2], &plain(), 1).expect("a picture");
    assert_close(radiance_at(&replaced, 9, 9), Vec3::splat(2.0));
}

#[test]
fn files_hold_what_the_picture_holds() {
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
fn a_file_that_cannot_be_written_or_read_is_named() {
    let Some(picture) = draw(&four_texels(), &plain()) else { return };
    let nowhere = Path::new("/no/such/folder/a.png");
    let messages = [picture.save(nowhere).expect_err("no folder"), Raster::load(nowhere).expect_err("no file")];
    for message in messages.map(|error| error.to_string()) {
        assert!(message.contains("/no/such/folder/a.png"), "{message}");
    }
}

/// A box open towards the camera with a red and a green wall, a lamp and light that falls off from the lamp.
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
fn a_room_looks_as_it_did() {
    let Some(gpu) = gpu() else { return };
    let camera = Camera::looking_at("room", Vec3::new(0.3, 0.2, 4.2), Vec3::ZERO, 0.65);
    let scene = SceneBuffers::new(gpu, &room().baked);
    let drawn = picture_of(gpu, &scene, &camera, [256; 2], &Look::default(), 1);
    assert_snapshot("room", &drawn.expect("a picture"));
}

#[test]
fn the_processor_shows_light_as_the_gpu_does() {
    // From dark to far beyond white, in colour, and a corner where nothing is.
    let mut quads = Quads::with_groups(1);
    let material = quads.material(paint(Vec3::new(0.9, 0.6, 0.3)));
    quads.quad(Vec3::new(-1.0, -1.0, 0.0), 1.9 * Vec3::X, 1.7 * Vec3::Y, material);
    quads.light(GroupId(0), |at| Vec3::new(3e3, 1e3, 2e3) * (0.01 + (at.x + 1.0) * (at.y + 1.0)), |_| Vec3::ZERO);
    for exposure in [Exposure::Auto, Exposure::Ev(-9.0), Exposure::Ev(-6.0)] {
        for tone_map in [ToneMap::Neutral, ToneMap::Linear] {
            let look = Look { exposure, tone_map, ..Look::default() };
            let Some(drawn) = draw(&quads, &look) else { return };
            let developed = develop([SIZE; 2], drawn.radiance.clone(), &look);
            let off = drawn.display.iter().zip(&developed.display).map(|(a, b)| a.abs_diff(*b)).max();
            assert!(off <= Some(1), "{look:?}: {off:?} steps apart");
        }
    }
}
