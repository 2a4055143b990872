//! Pictures of a coarse mesh with light in tiles, compared with pictures of the elements with light at their vertices.

use std::sync::Arc;

use glam::Vec3;
use hemicube::baked::BakedScene;
use hemicube::gpu::Gpu;
use hemicube::patch::{MeshSettings, PatchMesh};
use hemicube::render::scene::SceneBuffers;
use hemicube::render::{
    Exposure, PictureRequest, RenderSettings, Renderer, Shading, ShadowScene, ShadowSettings, ShadowTechnique,
    draw_picture,
};
use hemicube::scene::{Camera, Projection, builtin};
use wgpu::TextureFormat;

use crate::support::device::gpu;
use crate::support::screen::displayed;

const SIZE: [u32; 2] = [160, 90];

/// The Cornell box in small elements, with light that varies in waves.
fn waving() -> BakedScene {
    let scene = builtin::cornell();
    let mesh = PatchMesh::new(&scene, &MeshSettings { element_size: 0.2, patch_size: 1.0 }).expect("a mesh");
    let mut baked = BakedScene::of_mesh(&scene, &mesh);
    let wave = |p: Vec3, normal: Vec3| Vec3::splat(2.0) + (2.0 * p + normal).map(f32::sin);
    let light = &mut baked.light.groups[0];
    for (v, vertex) in baked.scene.vertices.iter().enumerate() {
        light.direct[v] = wave(vertex.position, vertex.normal);
        light.indirect[v] = wave(-vertex.position, vertex.normal);
    }
    baked
}

/// Returns the largest difference of display values, and the share of pixels that differ by more than two steps.
fn difference(a: &[u8], b: &[u8]) -> (u8, f64) {
    let pixels = a.as_chunks::<4>().0.iter().zip(b.as_chunks::<4>().0);
    let steps = pixels.map(|(a, b)| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0));
    let (largest, num_far, num) =
        steps.fold((0, 0, 0), |(largest, far, num), step| (step.max(largest), far + usize::from(step > 2), num + 1));
    (largest, num_far as f64 / f64::from(num))
}

/// Draws a picture with tiles and one without.
fn both(gpu: &Gpu, baked: &BakedScene, camera: &Camera, settings: &RenderSettings, samples: u32) -> [Vec<u8>; 2] {
    let with_tiles = SceneBuffers::new(gpu, baked);
    assert!(with_tiles.tiled.is_some());
    let mut without = SceneBuffers::new(gpu, baked);
    without.tiled = None;
    let shadows = Arc::new(ShadowScene::new(gpu, Arc::new(baked.scene.clone())));
    [with_tiles, without].map(|buffers| {
        let request = PictureRequest::new(&buffers, camera, SIZE, settings);
        let request = PictureRequest { shadows: Some(&shadows), ..request };
        draw_picture(gpu, &request, samples).expect("a picture").display
    })
}

#[test]
fn tiles_look_like_the_elements_that_they_replace() {
    let Some(gpu) = gpu() else { return };
    let baked = waving();
    let lit = RenderSettings { exposure: Exposure::Ev(-1.0), ..RenderSettings::default() };
    let map = ShadowSettings::new(ShadowTechnique::Map);
    let camera = &baked.scene.cameras[0];
    let beside = Camera { position: camera.position + Vec3::new(7.0, 0.0, 2.0), ..camera.clone() };
    let flat = Camera { projection: Projection::Orthographic { half_height: 2.0 }, ..camera.clone() };
    for (name, settings, camera, samples) in [
        ("lit", lit.clone(), camera, 1),
        ("lit, several samples", lit.clone(), camera, 4),
        (
            "indirect, with ambient light",
            RenderSettings { direct: 0.0, ambient: Vec3::splat(0.5), ..lit.clone() },
            camera,
            1,
        ),
        ("dimmed", RenderSettings { group_weights: vec![Vec3::new(0.5, 1.0, 2.0)], ..lit.clone() }, camera, 1),
        ("false colour", RenderSettings { shading: Shading::FalseColour, ..lit.clone() }, camera, 1),
        ("irradiance", RenderSettings { shading: Shading::IrradianceOnly, ..lit.clone() }, camera, 1),
        ("albedo", RenderSettings { shading: Shading::Albedo, ..lit.clone() }, camera, 1),
        ("shadow maps", RenderSettings { shadows: Some(map.clone()), ..lit.clone() }, camera, 1),
        ("orthographic", lit.clone(), &flat, 1),
        ("from outside", lit.clone(), &beside, 1),
        ("backs from outside", RenderSettings { cull_back: false, ..lit.clone() }, &beside, 1),
    ] {
        let [tiles, elements] = both(gpu, &baked, camera, &settings, samples);
        let (largest, share) = difference(&tiles, &elements);
        assert!(share < 0.003, "{name}: {share} of the pixels differ, by up to {largest}");
    }
}

#[test]
fn the_tiles_of_a_hidden_instance_are_not_drawn() {
    let Some(gpu) = gpu() else { return };
    let baked = waving();
    let camera = &baked.scene.cameras[0];
    let lit = RenderSettings { exposure: Exposure::Ev(-1.0), ..RenderSettings::default() };
    let all = SceneBuffers::new(gpu, &baked);
    let hidden = baked.scene.triangles[baked.scene.triangles.len() - 1].instance;
    let [tiles, mut elements] = [(); 2].map(|()| all.part(gpu, &baked.scene, |triangle| triangle.instance != hidden));
    elements.tiled = None;
    let [whole, tiles, elements] = [&all, &tiles, &elements].map(|buffers| {
        draw_picture(gpu, &PictureRequest::new(buffers, camera, SIZE, &lit), 1).expect("a picture").display
    });
    assert!(difference(&tiles, &whole).1 > 0.02, "something is gone");
    let (largest, share) = difference(&tiles, &elements);
    assert!(share < 0.003, "{share} of the pixels differ, by up to {largest}");
}

#[test]
fn tiles_are_filled_again_after_new_light_or_new_weights() {
    let Some(gpu) = gpu() else { return };
    let mut baked = waving();
    let camera = baked.scene.cameras[0].clone();
    let lit = RenderSettings { exposure: Exposure::Ev(-1.0), ..RenderSettings::default() };
    let buffers = SceneBuffers::new(gpu, &baked);
    let [mut one, mut other] = [(); 2].map(|()| Renderer::new(gpu, TextureFormat::Rgba8Unorm, 1));
    let shown = |renderer: &mut Renderer, settings: &RenderSettings| {
        displayed(gpu, renderer, &PictureRequest::new(&buffers, &camera, SIZE, settings))
    };
    let first = shown(&mut one, &lit);
    let dimmed = shown(&mut other, &RenderSettings { group_weights: vec![Vec3::splat(0.5)], ..lit.clone() });
    assert!(difference(&first, &dimmed).1 > 0.3, "half of the light is darker");
    assert_eq!(difference(&first, &shown(&mut one, &lit)).0, 0, "another picture has weighed the light of both");
    baked.light.groups[0].direct.fill(Vec3::ZERO);
    buffers.set_light(gpu, &baked.light);
    let without = shown(&mut one, &lit);
    let indirect = RenderSettings { direct: 0.0, ..lit };
    assert!(difference(&first, &without).1 > 0.3, "there is no direct light any more");
    assert_eq!(difference(&without, &shown(&mut one, &indirect)).0, 0);
}
