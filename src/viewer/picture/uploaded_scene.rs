//! A scene on the window's device.

use std::sync::Arc;

use crate::gpu::Gpu;
use crate::render::ShadowScene;
use crate::render::scene::SceneBuffers;
use crate::scene::Scene;

/// A scene and its buffers on the device.
#[derive(Clone)]
pub struct UploadedScene {
    /// The triangles that are drawn: those of the file, or the elements of a bake.
    pub scene: Arc<Scene>,
    /// The triangles and their light on the device.
    pub buffers: Arc<SceneBuffers>,
    /// The casters and lights on the device.
    pub shadows: Arc<ShadowScene>,
}

impl UploadedScene {
    /// Drops cached results of shaders: shadow maps, and the light in tiles.
    pub fn forget_drawn(&mut self, gpu: &Gpu) {
        self.buffers.forget_tiles();
        self.shadows = Arc::new(ShadowScene::new(gpu, Arc::clone(&self.scene)));
    }
}
