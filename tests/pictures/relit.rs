//! One renderer, and light that changes between its pictures.

use std::f32::consts::PI;

use glam::Vec3;
use hemicube::base::ids::GroupId;
use hemicube::gpu::Gpu;
use hemicube::render::scene::SceneBuffers;
use hemicube::render::{PictureRequest, RenderSettings, Renderer};
use wgpu::TextureFormat;

use super::stage::{SIZE, plain};
use crate::support::device::gpu;
use crate::support::quads::{Quads, paint, square_camera};
use crate::support::screen::displayed;

/// Returns the display value of the red channel in the middle of a picture.
fn red(gpu: &Gpu, renderer: &mut Renderer, scene: &SceneBuffers, settings: &RenderSettings) -> u8 {
    displayed(gpu, renderer, &PictureRequest::new(scene, &square_camera(), [SIZE; 2], settings))
        [(4 * (SIZE * SIZE / 2 + SIZE / 2)) as usize]
}

/// White paint with radiance 0.5 from group `group` alone, half of it direct.
fn lit_by(num_groups: usize, group: usize) -> Quads {
    let mut quads = Quads::with_groups(num_groups);
    let white = quads.material(paint(Vec3::ONE));
    quads.quad(Vec3::new(-1.0, -1.0, 0.0), 2.0 * Vec3::X, 2.0 * Vec3::Y, white);
    for number in 0..num_groups {
        let part = if number == group { Vec3::splat(0.25 * PI) } else { Vec3::ZERO };
        quads.light(GroupId::new(number), |_| part, |_| part);
    }
    quads
}

#[test]
fn the_next_picture_shows_light_that_was_dimmed_or_written_again() {
    let Some(gpu) = gpu() else { return };
    const HALF: u8 = 188;
    const QUARTER: u8 = 137;
    let mut renderer = Renderer::new(gpu, TextureFormat::Rgba8Unorm, 1);
    let mut quads = lit_by(2, 1);
    let scene = SceneBuffers::new(gpu, &quads.baked);
    let mut shown = |scene: &SceneBuffers, settings: &RenderSettings| red(gpu, &mut renderer, scene, settings);
    assert_eq!(shown(&scene, &plain()), HALF);
    let dimmed = RenderSettings { group_weights: vec![Vec3::ONE, Vec3::splat(0.5)], ..plain() };
    assert_eq!(shown(&scene, &dimmed), QUARTER);
    let of_the_other = RenderSettings { group_weights: vec![Vec3::splat(0.5), Vec3::ONE], ..plain() };
    assert_eq!(shown(&scene, &of_the_other), HALF);
    assert_eq!(shown(&scene, &RenderSettings { indirect: 0.0, ..of_the_other }), QUARTER);
    // Replaces the light of the same scene, then draws another scene of the same size.
    quads.light(GroupId(1), |_| Vec3::splat(0.25 * PI), |_| Vec3::ZERO);
    scene.set_light(gpu, &quads.baked.light);
    assert_eq!(shown(&scene, &plain()), QUARTER);
    assert_eq!(shown(&SceneBuffers::new(gpu, &lit_by(1, 0).baked), &plain()), HALF);
    assert_eq!(shown(&scene, &plain()), QUARTER);
}
