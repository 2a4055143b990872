//! Prepares a scene for all shadow techniques.

use std::sync::Arc;

use super::cutout::SceneCutouts;
use super::shared::scene::ShadowScene;
use crate::gpu::Gpu;
use crate::scene::Scene;

impl ShadowScene {
    /// Finds the casters of a scene whose triangles have been uploaded as
    /// [`SceneBuffers`](crate::render::scene::SceneBuffers), and uploads the casters with holes. Other data is computed
    /// by the first technique that needs it.
    #[must_use]
    pub fn new(gpu: &Gpu, scene: Arc<Scene>) -> Self {
        let shadows = Self::with_casters(scene);
        shadows.kept(|| SceneCutouts::new(gpu, shadows.scene()));
        shadows
    }
}
