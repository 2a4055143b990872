//! A picture that nobody sees, drawn before the first one that somebody does: a driver that draws on the processor
//! compiles shaders when they first draw, which would hold up a walk that has just begun.

use std::sync::Arc;

use crate::baked::BakedScene;
use crate::gpu::Gpu;
use crate::render::scene::SceneBuffers;
use crate::render::{RenderSettings, ShadowScene, View};
use crate::scene::builtin;
use crate::viewer::picture::canvas::Canvas;
use crate::viewer::picture::content::{Detail, PictureContent};

/// Sides that are no powers of two: drivers may compile for those apart.
const SIZE: [u32; 2] = [90, 60];

/// Draws the Cornell box as a sketch and as it looks at rest.
pub fn warm_up(gpu: &Gpu, canvas: &mut Canvas) {
    let dark = BakedScene::dark(builtin::cornell());
    let Some(camera) = dark.scene.cameras.first() else { return };
    let content = PictureContent {
        view: View::from_camera(camera, SIZE[0] as f32 / SIZE[1] as f32),
        scene: Arc::new(SceneBuffers::new(gpu, &dark)),
        shadows: Arc::new(ShadowScene::new(gpu, Arc::new(dark.scene))),
        light: 0,
        settings: RenderSettings::default(),
        compared_shadows: None,
        overlay: None,
        size: SIZE,
    };
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("warm-up") });
    for detail in [Detail::Plain, Detail::Sketch] {
        canvas.draw(gpu, &mut encoder, content.clone(), detail, None);
    }
    gpu.queue.submit([encoder.finish()]);
    canvas.forget();
}
