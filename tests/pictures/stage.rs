//! A square seen from the front, and access to its pixels.

use std::f32::consts::PI;

use glam::Vec3;
use hemicube::render::scene::SceneBuffers;
use hemicube::render::{Exposure, Picture, PictureRequest, RenderSettings, ToneMap, draw_picture};
use hemicube::scene::Material;

use crate::support::device::gpu;
use crate::support::quads::{Quads, paint, slot, square_camera, texture};

pub const SIZE: u32 = 64;

/// Settings that display radiance without exposure or tone mapping.
pub fn plain() -> RenderSettings {
    RenderSettings {
        exposure: Exposure::Ev(0.0),
        tone_map: ToneMap::Linear,
        background: Vec3::ZERO,
        metal_as_diffuse: false,
        ..RenderSettings::default()
    }
}

/// Draws the square from the front with one sample a pixel.
pub fn draw(quads: &Quads, settings: &RenderSettings) -> Option<Picture> {
    let gpu = gpu()?;
    let scene = SceneBuffers::new(gpu, &quads.baked);
    Some(draw_picture(gpu, &PictureRequest::new(&scene, &square_camera(), [SIZE; 2], settings), 1).expect("a picture"))
}

pub fn radiance_at(picture: &Picture, x: u32, y: u32) -> Vec3 {
    let [r, g, b, _] = picture.radiance[(y * picture.width + x) as usize];
    Vec3::new(r, g, b)
}

pub fn display_at(picture: &Picture, x: u32, y: u32) -> [u8; 3] {
    let at = 4 * (y * picture.width + x) as usize;
    [picture.display[at], picture.display[at + 1], picture.display[at + 2]]
}

/// Returns the radiance in the middle of the square.
pub fn centre(quads: &Quads, settings: &RenderSettings) -> Option<Vec3> {
    draw(quads, settings).map(|picture| radiance_at(&picture, SIZE / 2, SIZE / 2))
}

#[track_caller]
pub fn assert_close(found: Vec3, expected: Vec3) {
    assert_within(1e-3, found, expected);
}

/// Asserts that colours are equal within `tolerance`, a share of the largest channel.
#[track_caller]
pub fn assert_within(tolerance: f32, found: Vec3, expected: Vec3) {
    let largest = expected.abs().max_element().max(1e-3);
    assert!((found - expected).abs().max_element() <= tolerance * largest, "{found}, not {expected}");
}

/// The square with a texture of 2 x 2 texels: red green / blue white.
pub fn four_texels() -> Quads {
    let texels = [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [255, 255, 255, 255]];
    let mut quads = Quads::square(Material { base_colour_texture: Some(slot(0)), ..paint(Vec3::ONE) }, Vec3::splat(PI));
    quads.baked.scene.textures.push(texture(2, &texels));
    quads
}

/// Returns the display colours of the four quarters, row by row.
pub fn quarters(picture: &Picture) -> [[u8; 3]; 4] {
    [(16, 16), (48, 16), (16, 48), (48, 48)].map(|(x, y)| display_at(picture, x, y))
}
