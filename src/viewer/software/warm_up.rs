//! A small hidden picture that is drawn before the first shown one. A software driver compiles shaders when they first
//! draw, which would otherwise interrupt the first movement.

use std::sync::Arc;

use crate::baked::BakedScene;
use crate::gpu::Gpu;
use crate::render::scene::SceneBuffers;
use crate::render::{RenderSettings, ShadowScene, View};
use crate::scene::builtin;
use crate::viewer::picture::content::PictureContent;

/// Width and height, pixels. They are not powers of two, for which drivers may compile other shaders.
const SIZE: [u32; 2] = [90, 60];

/// Returns the content of the picture: the Cornell box without light.
#[must_use]
pub fn warm_up_content(gpu: &Gpu) -> Option<PictureContent> {
    let dark = BakedScene::dark(builtin::cornell());
    let view = View::from_camera(dark.scene.cameras.first()?, SIZE[0] as f32 / SIZE[1] as f32);
    Some(PictureContent {
        view,
        scene: Arc::new(SceneBuffers::new(gpu, &dark)),
        shadows: Arc::new(ShadowScene::new(gpu, Arc::new(dark.scene))),
        light: 0,
        settings: RenderSettings::default(),
        compared_shadows: None,
        overlay: None,
        size: SIZE,
    })
}
