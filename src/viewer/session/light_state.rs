//! State of the light of the open scene.

use std::time::Duration;

use crate::base::progress::Stage;

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
        /// Completed fraction of the stage, 0..1.
        done: f32,
        /// Time since the work began.
        elapsed: Duration,
        /// True if the user has cancelled the work.
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
