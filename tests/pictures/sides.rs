//! Holes, surfaces that blend, and the two sides of a surface.

use std::f32::consts::PI;

use glam::Vec3;
use hemicube::base::ids::{GroupId, TriangleId};
use hemicube::render::scene::SceneBuffers;
use hemicube::render::{PictureRequest, RenderSettings, draw_picture};
use hemicube::scene::{AlphaMode, Material};

use super::stage::{SIZE, assert_close, draw, plain, quarters, radiance_at};
use crate::support::device::gpu;
use crate::support::quads::{Quads, paint, slot, square_camera, texture};

/// A white square with a hole in its upper left quarter, in front of a red wall.
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
        let drawn = draw_picture(gpu, &PictureRequest::new(&scene, &square_camera(), [SIZE; 2], &plain()), samples);
        let white = [255; 3];
        assert_eq!(quarters(&drawn.expect("a picture")), [[255, 0, 0], white, white, white], "{samples} samples");
    }
}

#[test]
fn blended_surfaces_let_the_rest_of_the_light_through() {
    let Some(picture) = draw(&window(AlphaMode::Blend, 51), &plain()) else { return };
    assert_close(radiance_at(&picture, 16, 16), Vec3::new(1.0, 0.2, 0.2));
    assert_close(radiance_at(&picture, 48, 16), Vec3::ONE);
}

#[test]
fn opaque_surfaces_ignore_alpha() {
    let Some(picture) = draw(&window(AlphaMode::Opaque, 0), &plain()) else { return };
    assert_close(radiance_at(&picture, 16, 16), Vec3::ONE);
}

/// The square, seen from behind.
fn from_behind(material: Material) -> Quads {
    let mut quads = Quads::with_groups(1);
    let material = quads.material(material);
    quads.quad(Vec3::new(1.0, -1.0, 0.0), -2.0 * Vec3::X, 2.0 * Vec3::Y, material);
    quads.light(GroupId(0), |_| Vec3::splat(PI), |_| Vec3::ZERO);
    quads
}

/// Returns radiance and coverage in the middle of the picture.
fn middle(quads: &Quads, settings: &RenderSettings) -> Option<[f32; 2]> {
    let picture = draw(quads, settings)?;
    let [r, _, _, a] = picture.radiance[(SIZE / 2 * SIZE + SIZE / 2) as usize];
    Some([r, a])
}

#[test]
fn a_back_is_culled_or_black_or_a_second_face() {
    let single = from_behind(paint(Vec3::ONE));
    let double = from_behind(Material { double_sided: true, ..paint(Vec3::ONE) });
    let solid = RenderSettings { cull_back: false, ..plain() };
    let Some(culled) = middle(&single, &plain()) else { return };
    assert_eq!(culled, [0.0, 0.0]);
    assert_eq!(middle(&single, &solid).expect("a GPU"), [0.0, 1.0]);
    assert_eq!(middle(&double, &plain()).expect("a GPU"), [1.0, 1.0]);
}

#[test]
fn baked_twins_are_seen_each_from_its_side() {
    // The front twin faces away from the camera and is lit ten times as strongly.
    let mut quads = from_behind(Material { double_sided: true, ..paint(Vec3::ONE) });
    quads.quad(Vec3::new(-1.0, -1.0, 0.0), 2.0 * Vec3::X, 2.0 * Vec3::Y, hemicube::base::ids::MaterialId(0));
    [2, 3].map(TriangleId).into_iter().for_each(|back| quads.baked.scene.sides.add_back(back));
    quads.light(GroupId(0), |_| Vec3::splat(PI), |_| Vec3::ZERO);
    for lit in &mut quads.baked.light.groups[0].direct[..4] {
        *lit *= 10.0;
    }
    let solid = RenderSettings { cull_back: false, ..plain() };
    let Some(picture) = draw(&quads, &solid) else { return };
    assert!(picture.radiance.iter().all(|pixel| (pixel[0] - 1.0).abs() < 1e-3));
}
