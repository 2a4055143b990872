//! A job as seen from its own thread.

use std::sync::Arc;

use super::result::JobResult;
use crate::base::progress::{Cancel, Gate, Progress, Stage};

/// Receives the number and a result of a job.
pub(super) type Deliver = Arc<dyn Fn(u32, JobResult) + Send + Sync>;

/// Switches of a running job, shared by its thread and the window.
#[derive(Default)]
pub(super) struct Controls {
    pub cancel: Cancel,
    pub gate: Gate,
}

impl Controls {
    /// Requests that the job ends, even if it is paused.
    pub fn end(&self) {
        self.cancel.cancel();
        self.gate.open();
    }
}

/// A job as seen from its own thread. It sends results, and pauses or cancels the work.
pub struct JobHandle {
    pub(super) number: u32,
    pub(super) controls: Arc<Controls>,
    pub(super) deliver: Deliver,
}

impl JobHandle {
    /// Sends a result to the window.
    pub fn send(&self, result: JobResult) {
        (self.deliver)(self.number, result);
    }
}

impl Progress for JobHandle {
    fn report(&self, _: Stage, _: f32) {}

    fn is_cancelled(&self) -> bool {
        self.controls.cancel.is_cancelled()
    }

    fn rest(&self) {
        self.controls.gate.pass();
    }
}
