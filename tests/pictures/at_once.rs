//! Display colours written by the surface pass, compared with those of the radiance and tone mapping passes.

use std::sync::Arc;

use glam::Vec3;
use hemicube::baked::{BakedScene, VertexLight};
use hemicube::gpu::Gpu;
use hemicube::render::scene::SceneBuffers;
use hemicube::render::{
    Exposure, MeteredExposure, PictureRequest, RenderSettings, Renderer, Shading, ShadowScene, ShadowSettings,
    ShadowTechnique, ToneMap, draw_picture,
};
use hemicube::scene::{AlphaMode, Scene, builtin};
use wgpu::TextureFormat;

use crate::support::device::gpu;
use crate::support::screen::displayed;

const SIZE: [u32; 2] = [160, 90];

/// Returns the number of pixels that differ by more than a step of eight bits, and the number of pixels that are
/// neither black nor white.
fn compare(gpu: &Gpu, scene: &Scene, settings: &RenderSettings) -> [usize; 2] {
    let light = VertexLight::dark(scene.light_groups.len(), scene.vertices.len());
    let buffers = SceneBuffers::new(gpu, &BakedScene::new(scene.clone(), light));
    let shadows = Arc::new(ShadowScene::new(gpu, Arc::new(scene.clone())));
    let camera = &scene.cameras[0];
    let request = PictureRequest::new(&buffers, camera, SIZE, settings);
    let request = PictureRequest { shadows: Some(&shadows), ..request };
    let of_radiance = draw_picture(gpu, &request, 1).expect("a picture").display;
    let mut renderer = Renderer::new(gpu, TextureFormat::Rgba8Unorm, 1);
    let at_once = displayed(gpu, &mut renderer, &request);
    let pixels = at_once.as_chunks::<4>().0.iter().zip(of_radiance.as_chunks::<4>().0);
    let differing = pixels.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 1)).count();
    let grey = at_once.as_chunks::<4>().0.iter().filter(|pixel| !matches!(pixel[..3], [0, 0, 0] | [255, 255, 255]));
    [differing, grey.count()]
}

#[test]
fn display_colours_of_the_surface_pass_equal_those_of_the_tone_map_pass() {
    let Some(gpu) = gpu() else { return };
    let gallery = builtin::gallery();
    let plain = RenderSettings { exposure: Exposure::Ev(1.0), ambient: Vec3::splat(0.2), ..RenderSettings::default() };
    let shadows = |technique| Some(ShadowSettings::new(technique));
    let looks = [
        plain.clone(),
        RenderSettings { tone_map: ToneMap::Linear, ..plain.clone() },
        RenderSettings { shading: Shading::FalseColour, ..plain.clone() },
        RenderSettings { shading: Shading::Albedo, ..plain.clone() },
        RenderSettings { shading: Shading::Normals, ..plain.clone() },
        RenderSettings { shadows: shadows(ShadowTechnique::Map), exposure: Exposure::Ev(-4.0), ..plain.clone() },
        RenderSettings {
            shadows: shadows(ShadowTechnique::VolumeDepthFail),
            exposure: Exposure::Ev(-4.0),
            ..plain.clone()
        },
    ];
    for settings in looks {
        let [differing, grey] = compare(gpu, &gallery, &settings);
        let name = (settings.shading, settings.tone_map, settings.shadows.map(|shadows| shadows.technique));
        assert!(differing == 0 && grey > 10_000, "{name:?}: {differing} pixels differ, {grey} are grey");
    }
}

#[test]
fn glass_is_blended_before_tone_mapping() {
    let Some(gpu) = gpu() else { return };
    let mut scene = builtin::gallery();
    for material in &mut scene.materials {
        material.alpha_mode = AlphaMode::Blend;
        material.base_colour.w = 0.5;
    }
    let settings =
        RenderSettings { exposure: Exposure::Ev(3.0), ambient: Vec3::splat(0.2), ..RenderSettings::default() };
    assert_eq!(compare(gpu, &scene, &settings)[0], 0);
}

#[test]
fn pictures_of_a_movement_converge_to_their_own_exposure() {
    let Some(gpu) = gpu() else { return };
    let scene = builtin::gallery();
    let light = VertexLight::dark(scene.light_groups.len(), scene.vertices.len());
    let buffers = SceneBuffers::new(gpu, &BakedScene::new(scene.clone(), light));
    let [dim, bright] =
        [0.02, 40.0].map(|ambient| RenderSettings { ambient: Vec3::splat(ambient), ..RenderSettings::default() });
    let [dim, bright] =
        [&dim, &bright].map(|settings| PictureRequest::new(&buffers, &scene.cameras[0], SIZE, settings));
    let mut renderer = Renderer::new(gpu, TextureFormat::Rgba8Unorm, 1);
    let exact = displayed(gpu, &mut renderer, &bright);
    let ev = renderer.metered_ev(gpu).expect("a device").expect("metered");
    // Starts with the exposure of another picture and draws this one.
    let _ = displayed(gpu, &mut renderer, &dim);
    let bright = PictureRequest { exposure: MeteredExposure::OfLast, ..bright };
    let first = displayed(gpu, &mut renderer, &bright);
    let second = displayed(gpu, &mut renderer, &bright);
    let mean = |picture: &[u8]| picture.iter().map(|&value| f64::from(value)).sum::<f64>() / picture.len() as f64;
    assert!(mean(&first) > mean(&exact) + 20.0, "{} after {}", mean(&first), mean(&exact));
    assert!((mean(&second) - mean(&exact)).abs() < 2.0, "{} for {}", mean(&second), mean(&exact));
    // Metering every fourth pixel gives nearly the same exposure as metering every other one.
    let new_ev = renderer.metered_ev(gpu).expect("a device").expect("metered");
    assert!((new_ev - ev).abs() < 0.05, "{new_ev} for {ev}");
}
