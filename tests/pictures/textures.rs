//! Textures: orientation, coordinates, and averages.

use std::f32::consts::PI;

use glam::{Affine2, Vec2, Vec3};
use hemicube::scene::Material;

use super::stage::{assert_within, centre, draw, four_texels, plain, quarters, radiance_at};
use crate::support::quads::{Quads, paint, slot, texture};

#[test]
fn textures_stand_upright() {
    let Some(picture) = draw(&four_texels(), &plain()) else { return };
    assert_eq!(quarters(&picture), [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 255]]);
}

#[test]
fn texture_transform_and_coordinate_set_are_applied() {
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
fn fine_textures_are_averaged_in_linear_light() {
    let mut quads = Quads::square(Material { base_colour_texture: Some(slot(0)), ..paint(Vec3::ONE) }, Vec3::splat(PI));
    let board: Vec<[u8; 4]> = (0..256 * 256).map(|i| [if (i + i / 256) % 2 == 0 { 255 } else { 0 }; 4]).collect();
    quads.baked.scene.textures.push(texture(256, &board));
    let Some(radiance) = centre(&quads, &plain()) else { return };
    assert!((radiance - Vec3::splat(0.5)).abs().max_element() < 5e-3, "{radiance}");
}
