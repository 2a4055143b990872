//! A request for one picture: scene, camera and settings.

use std::sync::Arc;

use super::{RenderSettings, ShadowScene, View};
use crate::gpu::Stopwatch;
use crate::render::scene::SceneBuffers;
use crate::scene::Camera;

/// A request for one picture: scene, camera and settings.
#[derive(Clone, Copy)]
pub struct PictureRequest<'a> {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// The scene on the device.
    pub scene: &'a SceneBuffers,
    /// Casters and lights of the scene. Without them, direct light comes from the vertices whatever the settings are.
    pub shadows: Option<&'a Arc<ShadowScene>>,
    /// The camera.
    pub view: View,
    /// Shading of the surfaces, exposure, and weights of the light.
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
    /// The picture before it, as while the camera moves. With one sample a pixel and no surface that blends, the
    /// surface pass then writes display colours directly, which is faster.
    OfLast,
}

impl<'a> PictureRequest<'a> {
    /// Creates a request for a picture that `camera` takes of a scene, with the stored light of the scene.
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
