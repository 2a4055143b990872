//! The content of a picture of the viewer, and its level of detail.

use std::sync::Arc;

use crate::render::scene::SceneBuffers;
use crate::render::shadow::SampleBatch;
use crate::render::{MeteredExposure, Overlay, PictureRequest, RenderSettings, ShadowScene, ShadowSettings, View};
use crate::viewer::settings::comparison::ComparedShadows;

/// Level of detail of a picture, from coarse to fine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Detail {
    /// During a movement on a software driver: one sample per pixel, at half the size if that is faster.
    Sketch,
    /// At rest during a bake on a software driver: one sample per pixel.
    Plain,
    /// Several samples per pixel.
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
    /// Version of the light in `scene`. It increases by one with each upload.
    pub light: u32,
    /// The view.
    pub view: View,
    /// The render settings.
    pub settings: RenderSettings,
    /// Second shadows of a comparison; `None` if the shadows of `settings` are not compared.
    pub compared_shadows: Option<ComparedShadows>,
    /// Marks over the picture.
    pub overlay: Option<Arc<Overlay>>,
    /// Width and height, pixels.
    pub size: [u32; 2],
}

impl PictureContent {
    /// Returns the request that draws the content, without its overlay.
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

    /// Returns the content with other shadows.
    #[must_use]
    pub fn with_shadows(&self, shadows: &ShadowSettings) -> Self {
        let settings = RenderSettings { shadows: Some(shadows.clone()), ..self.settings.clone() };
        Self { settings, ..self.clone() }
    }

    /// Returns the content lit by one batch of the light samples, or by all of them.
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
    /// Content of the picture.
    pub content: PictureContent,
    /// Level of detail of the picture.
    pub detail: Detail,
    /// Light samples that the picture adds, if they are added in batches.
    pub batch: Option<SampleBatch>,
    /// True if the batch is still incomplete. The shown picture then does not change yet.
    pub is_partial: bool,
}
