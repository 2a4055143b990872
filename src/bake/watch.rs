//! Who watches a bake, and how long its stages take.

use std::time::Instant;

use crate::baked::{BakedScene, VertexLight};
use crate::base::progress::{Progress, Stage, Unwatched};

/// Who watches a bake: progress, and the light so far.
///
/// `mesh` comes first and again whenever it is refined, `light` as often as it is wanted, always for the last mesh; both are
/// called on the thread that bakes.
pub trait Watch: Progress {
    /// The mesh that light lies on from now on, with the light that is known.
    fn mesh(&self, _mesh: &BakedScene) {}
    /// A new estimate of the light would be welcome now (the last one has been taken).
    fn wants_light(&self) -> bool {
        false
    }
    /// Light so far, with the ambient estimate of what is still unshot.
    fn light(&self, _estimate: &VertexLight) {}
}

impl Watch for Unwatched {}

/// Seconds spent in each stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Seconds {
    /// Elements and patches.
    pub mesh: f64,
    /// Direct light.
    pub direct: f64,
    /// Form factors of patches, a part of `solve`.
    pub form_factors: f64,
    /// The system of patches.
    pub solve: f64,
    /// Vertex light.
    pub gather: f64,
    /// All of the bake.
    pub total: f64,
}

/// Measures the stages as they end.
pub(super) struct Clock {
    pub(super) seconds: Seconds,
    lap_start: Instant,
}

impl Clock {
    pub(super) fn start() -> Self {
        Self { seconds: Seconds::default(), lap_start: Instant::now() }
    }

    /// Adds the time since the last lap to a stage.
    pub(super) fn lap(&mut self, stage: Stage) {
        let seconds = self.lap_start.elapsed().as_secs_f64();
        self.lap_start = Instant::now();
        self.seconds.total += seconds;
        match stage {
            Stage::Load | Stage::Trace => {}
            Stage::Mesh => self.seconds.mesh += seconds,
            Stage::Direct => self.seconds.direct += seconds,
            Stage::Solve => self.seconds.solve += seconds,
            Stage::Gather => self.seconds.gather += seconds,
        }
    }
}
