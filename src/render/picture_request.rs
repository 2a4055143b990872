//! What one picture shows, and how.

use std::sync::Arc;

use super::{RenderSettings, ShadowScene, View};
use crate::gpu::Stopwatch;
use crate::render::scene::SceneBuffers;
use crate::scene::Camera;

/// What one picture shows, and how.
#[derive(Clone, Copy)]
pub struct PictureRequest<'a> {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// The scene on the device.
    pub scene: &'a SceneBuffers,
    /// Its casters and lights. Without them, direct light comes from the vertices whatever the settings say.
    pub shadows: Option<&'a Arc<ShadowScene>>,
    /// The camera.
    pub view: View,
    /// What is shown of surfaces, and how bright.
    pub settings: &'a RenderSettings,
    /// The picture that an automatic exposure is metered from.
    pub exposure: MeteredExposure,
    /// Measures the time of each pass.
    pub stopwatch: Option<&'a Stopwatch>,
}

/// The picture that an automatic exposure is metered from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MeteredExposure {
    /// This picture: it is drawn as radiance, metered, and then tone mapped.
    #[default]
    OfThis,
    /// The picture before it, as in a movement. With one sample a pixel and no surface that blends, the surface pass then
    /// writes display colours at once, which is faster.
    OfLast,
}

impl<'a> PictureRequest<'a> {
    /// A picture that `camera` takes of a scene, with the stored light of the scene.
    #[must_use]
    pub fn new(scene: &'a SceneBuffers, camera: &Camera, size: [u32; 2], settings: &'a RenderSettings) -> Self {
        Self {
            size,
            scene,
            shadows: None,
            view: View::from_camera(camera, size[0] as f32 / size[1] as f32),
            settings,
            exposure: MeteredExposure::OfThis,
            stopwatch: None,
        }
    }
}
