//! What shadows ask of a scene beyond its buffers.

use std::sync::Arc;

use crate::gpu::Gpu;
use crate::scene::Scene;

/// What shadows ask of a scene beyond its buffers.
pub struct ShadowScene {
    scene: Arc<Scene>,
}

impl ShadowScene {
    /// Prepares a scene that has been uploaded, with the same triangles.
    #[must_use]
    pub fn new(gpu: &Gpu, scene: Arc<Scene>) -> Self {
        let _ = gpu;
        Self { scene }
    }

    /// The scene.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }
}
