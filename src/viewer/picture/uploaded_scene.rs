//! A scene on the window's device.

use std::sync::Arc;

use crate::render::ShadowScene;
use crate::render::scene::SceneBuffers;
use crate::scene::Scene;

/// A scene and what the device holds of it.
#[derive(Clone)]
pub struct UploadedScene {
    /// The triangles that are drawn: those of the file, or the elements of a bake.
    pub scene: Arc<Scene>,
    /// The triangles and their light on the device.
    pub buffers: Arc<SceneBuffers>,
    /// The casters and lights on the device.
    pub shadows: Arc<ShadowScene>,
}
