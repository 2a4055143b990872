//! The time that the stages of a bake take.

use std::time::Instant;

use crate::base::progress::Stage;

/// Seconds spent in each stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Seconds {
    /// Subdivision into elements and patches.
    pub mesh: f64,
    /// Computation of direct light.
    pub direct: f64,
    /// Form factors of patches, a part of `solve`.
    pub form_factors: f64,
    /// Solution of the system of patches.
    pub solve: f64,
    /// Gathering of indirect light at vertices.
    pub gather: f64,
    /// The whole bake.
    pub total: f64,
}

/// Measures the stages as they end.
pub(in crate::bake) struct StageClock {
    seconds: Seconds,
    stage_start: Instant,
}

impl StageClock {
    pub fn start() -> Self {
        Self { seconds: Seconds::default(), stage_start: Instant::now() }
    }

    /// Adds the time since the end of the last stage to `stage`.
    pub fn end_stage(&mut self, stage: Stage) {
        let seconds = self.stage_start.elapsed().as_secs_f64();
        self.stage_start = Instant::now();
        self.seconds.total += seconds;
        match stage {
            Stage::Load | Stage::Trace => {}
            Stage::Mesh => self.seconds.mesh += seconds,
            Stage::Direct => self.seconds.direct += seconds,
            Stage::Solve => self.seconds.solve += seconds,
            Stage::Gather => self.seconds.gather += seconds,
        }
    }

    /// The times of all stages, with the part of `solve` that form factors took.
    pub fn finish(self, form_factors: f64) -> Seconds {
        Seconds { form_factors, ..self.seconds }
    }
}
