//! Facts about the light of the open scene: the running bake, the finished bake and its recording.

use std::time::Duration;

use crate::bake::{BakeSettings, Report};
use crate::base::progress::Stage;
use crate::patch::MeshSettings;
use crate::viewer::replay::Recording;

/// What the panels show of the bake.
#[derive(Clone, Default)]
pub struct BakeFacts<'a> {
    /// State of the light.
    pub light: LightState,
    /// The scene has its final light, which can be measured and saved.
    pub is_solved: bool,
    /// Settings of the next bake, and the sizes of elements and patches that follow from them in this scene.
    pub next: Option<(BakeSettings, MeshSettings)>,
    /// Progress of the bake: pairs of the seconds since its start and the unshot share of the light.
    pub curve: &'a [[f32; 2]],
    /// The certificate of the last bake.
    pub report: Option<&'a Report>,
    /// The recorded bake.
    pub recording: Option<&'a Recording>,
    /// A bake is being recorded.
    pub is_recording: bool,
}

/// State of the light of the open scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum LightState {
    /// No scene is open.
    #[default]
    Nothing,
    /// A scene is being loaded or baked.
    Working {
        /// The current stage.
        stage: Stage,
        /// The part of the stage that is done, 0..1.
        done: f32,
        /// Time since the work began.
        elapsed: Duration,
        /// The user has cancelled it.
        is_cancelled: bool,
    },
    /// The file stores its light.
    Stored,
    /// The bake has ended.
    Baked {
        /// Duration of the bake.
        elapsed: Duration,
    },
    /// There is no light: the last bake failed, or none was started.
    Dark,
}
