//! Device memory of shadows that are compared or switched off.

use std::sync::Arc;

use hemicube::baked::BakedScene;
use hemicube::gpu::Gpu;
use hemicube::render::scene::SceneBuffers;
use hemicube::render::{RenderSettings, ShadowScene, ShadowSettings, ShadowTechnique, View};
use hemicube::scene::builtin;
use hemicube::viewer::drawing::canvas::Canvas;
use hemicube::viewer::picture::content::{Detail, PictureContent};
use hemicube::viewer::settings::comparison::{ComparedShadows, ComparisonLayout};
use wgpu::{CommandEncoderDescriptor, TextureFormat};

use crate::support::device::gpu;

fn content(gpu: &Gpu, layout: Option<ComparisonLayout>) -> PictureContent {
    let dark = BakedScene::dark(builtin::cornell());
    let settings = ShadowSettings::new(ShadowTechnique::Map);
    PictureContent {
        view: View::from_camera(&dark.scene.cameras[0], 1.0),
        scene: Arc::new(SceneBuffers::new(gpu, &dark)),
        shadows: Arc::new(ShadowScene::new(gpu, Arc::new(dark.scene))),
        light: 0,
        settings: RenderSettings { shadows: Some(settings.clone()), ..RenderSettings::default() },
        compared_shadows: layout.map(|layout| ComparedShadows { settings, layout }),
        overlay: None,
        size: [32; 2],
    }
}

#[test]
fn a_scene_is_freed_when_its_comparison_ends() {
    let Some(gpu) = gpu() else { return };
    let mut canvas = Canvas::new(gpu, TextureFormat::Rgba8Unorm);
    let mut show = |content: PictureContent| {
        let mut encoder = gpu.device.create_command_encoder(&CommandEncoderDescriptor::default());
        canvas.draw(gpu, &mut encoder, content, Detail::Plain, None);
        gpu.queue.submit([encoder.finish()]);
    };
    for layout in [ComparisonLayout::Split, ComparisonLayout::Difference] {
        let compared = content(gpu, Some(layout));
        let shadows = Arc::downgrade(&compared.shadows);
        show(compared);
        assert!(shadows.upgrade().is_some(), "what is shown is held");
        show(content(gpu, None));
        assert!(shadows.upgrade().is_none(), "{layout:?} holds its scene");
    }
}

/// Counts the textures of this many pixels that accumulate the direct light of real-time shadows.
fn num_gathering(gpu: &Gpu, num_pixels: u64) -> usize {
    // Texels are half or single floats, and rows may be padded.
    let is_one = |bytes: u64| {
        [8, 16].iter().any(|pixel| bytes.checked_sub(pixel * num_pixels).is_some_and(|rest| rest < num_pixels / 4))
    };
    let report = gpu.device.generate_allocator_report().expect("the device counts what it holds");
    report.allocations.iter().filter(|held| held.name == "direct irradiance" && is_one(held.size)).count()
}

#[test]
fn textures_are_freed_when_shadows_are_switched_off() {
    let Some(gpu) = gpu() else { return };
    let mut canvas = Canvas::new(gpu, TextureFormat::Rgba8Unorm);
    let size = [1920, 1200];
    let mut num_gathering_with = |technique| {
        let mut shown = content(gpu, None);
        shown.size = size;
        shown.settings.shadows = technique;
        let mut encoder = gpu.device.create_command_encoder(&CommandEncoderDescriptor::default());
        canvas.draw(gpu, &mut encoder, shown, Detail::Plain, None);
        gpu.queue.submit([encoder.finish()]);
        gpu.wait().expect("the device draws");
        num_gathering(gpu, u64::from(size[0]) * u64::from(size[1]))
    };
    assert!(num_gathering_with(Some(ShadowSettings::new(ShadowTechnique::VolumeDepthPass))) > 0);
    assert_eq!(num_gathering_with(None), 0);
}
