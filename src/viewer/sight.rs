//! What a picture of the walkthrough shows, and how finely.

use std::sync::Arc;

use crate::render::scene::SceneBuffers;
use crate::render::{Overlay, RenderSettings, ShadowScene, ShadowSettings, View};

/// How finely a picture is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Detail {
    /// For movement: one sample a pixel, of half the size if need be.
    Sketch,
    /// One sample a pixel, for a rest while the bake needs the processor.
    Plain,
    /// Several samples a pixel.
    Fine,
    /// Traced by rays.
    Traced,
}

/// Everything that a picture depends on.
#[derive(Clone)]
pub struct Sight {
    /// What is seen.
    pub scene: Arc<SceneBuffers>,
    /// Its casters and lights.
    pub shadows: Arc<ShadowScene>,
    /// Counts how often the light of `scene` was renewed.
    pub light: u32,
    /// From where.
    pub view: View,
    /// How it is shown.
    pub settings: RenderSettings,
    /// With which shadows those of the settings are compared, and how.
    pub rival: Option<Rival>,
    /// What is drawn over it.
    pub overlay: Option<Arc<Overlay>>,
    /// Pixels across and down.
    pub size: [u32; 2],
}

/// Shadows that are compared with those of the settings.
#[derive(Clone, Debug, PartialEq)]
pub struct Rival {
    /// How they are found.
    pub settings: ShadowSettings,
    /// How they are compared.
    pub comparison: Comparison,
}

/// How shadows are compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Comparison {
    /// Both are shown, left and right of a divider.
    #[default]
    Split,
    /// Where they decide differently is shown as a heat map.
    Difference,
}
