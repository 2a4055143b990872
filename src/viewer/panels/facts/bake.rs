//! Facts about the light of the open scene: the running bake, the finished bake and its recording.

use crate::bake::{BakeSettings, Report};
use crate::patch::MeshSettings;
use crate::viewer::session::light_state::LightState;
use crate::viewer::solution::recording::Recording;

/// Facts about the light and its bake.
#[derive(Clone, Default)]
pub struct BakeFacts<'a> {
    /// State of the light.
    pub light: LightState,
    /// True if the scene has its final light, which can be measured and saved.
    pub is_solved: bool,
    /// Settings of the next bake, and the sizes of elements and patches that follow from them in this scene.
    pub next: Option<(BakeSettings, MeshSettings)>,
    /// Convergence of the bake: pairs of the seconds since its start and the unshot share of the light.
    pub curve: &'a [[f32; 2]],
    /// The certificate of the last bake.
    pub report: Option<&'a Report>,
    /// The recorded bake.
    pub recording: Option<&'a Recording>,
    /// True while a bake is being recorded.
    pub is_recording: bool,
}
