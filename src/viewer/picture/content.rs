//! What a picture of the viewer shows, and its level of detail.

use std::sync::Arc;

use crate::render::scene::SceneBuffers;
use crate::render::shadow::SampleBatch;
use crate::render::{MeteredExposure, Overlay, PictureRequest, RenderSettings, ShadowScene, ShadowSettings, View};
use crate::viewer::settings::comparison::ComparedShadows;

/// Level of detail of a picture, from coarse to fine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Detail {
    /// During a movement on a software driver: one sample a pixel, at half the size if that is faster.
    Sketch,
    /// At rest during a bake on a software driver: one sample a pixel.
    Plain,
    /// Several samples a pixel.
    Fine,
    /// Traced by rays.
    Traced,
}

/// Everything that a picture depends on.
#[derive(Clone)]
pub struct PictureContent {
    /// The triangles that are drawn.
    pub scene: Arc<SceneBuffers>,
    /// The casters and lights of the scene.
    pub shadows: Arc<ShadowScene>,
    /// Version of the light in `scene`: it rises by one with each upload.
    pub light: u32,
    /// The view.
    pub view: View,
    /// The render settings.
    pub settings: RenderSettings,
    /// Other shadows that those of `settings` are compared with.
    pub compared_shadows: Option<ComparedShadows>,
    /// Marks over the picture.
    pub overlay: Option<Arc<Overlay>>,
    /// Pixels across and down.
    pub size: [u32; 2],
}

impl PictureContent {
    /// The request that draws it, without its overlay.
    #[must_use]
    pub fn request(&self) -> PictureRequest<'_> {
        PictureRequest {
            size: self.size,
            scene: &self.scene,
            shadows: Some(&self.shadows),
            view: self.view,
            settings: &self.settings,
            exposure: MeteredExposure::OfThis,
            stopwatch: None,
        }
    }

    /// The same content with other shadows.
    #[must_use]
    pub fn with_shadows(&self, shadows: &ShadowSettings) -> Self {
        let settings = RenderSettings { shadows: Some(shadows.clone()), ..self.settings.clone() };
        Self { settings, ..self.clone() }
    }

    /// The same content lit by one batch of the light samples, or by all of them.
    #[must_use]
    pub fn with_batch(&self, batch: Option<SampleBatch>) -> Self {
        let mut content = self.clone();
        if let Some(shadows) = &mut content.settings.shadows {
            shadows.batch = batch;
        }
        content
    }
}

/// The next picture to draw.
pub struct NextPicture {
    /// What it shows.
    pub content: PictureContent,
    /// Its level of detail.
    pub detail: Detail,
    /// The light samples that it adds, if they come in batches.
    pub batch: Option<SampleBatch>,
    /// The batch is not complete with it: the picture does not change yet.
    pub is_partial: bool,
}
