//! Recordings, and results of all jobs.

use std::sync::Arc;

use crate::viewer::job::{JobKind, JobResult};
use crate::viewer::solution::recording::Recording;
use crate::viewer::window::viewer::Viewer;

impl Viewer {
    /// Stores or shows the result of a job, unless the job has been ended.
    pub fn receive(&mut self, job: u32, result: JobResult) {
        if !self.jobs.is_current(job) {
            return;
        }
        match result {
            JobResult::Reading(reading) => self.results.measurements.last = Some(*reading),
            JobResult::Grid(grid) => self.results.measurements.grid = Some(*grid),
            JobResult::PatchView(view) => self.results.patch_view = Some(view),
            JobResult::Recording(recording) => {
                self.panels.replay.is_on = true;
                self.panels.replay.moment = 0;
                self.results.recording = Some(recording);
            }
            JobResult::TracedView(traced) => {
                if self.surface.canvas.show_traced(&self.surface.gpu, &traced) {
                    self.picture.notes.num_rays = Some(traced.num_rays);
                }
            }
            JobResult::Written(path) => self.report_written(Ok(path)),
            JobResult::Failed(text) => self.show_trouble("This did not work", text),
        }
    }

    /// Starts to record the bake, or cancels the recording.
    pub(super) fn toggle_recording(&mut self) {
        if self.jobs.is_running(JobKind::Record) {
            self.jobs.end(JobKind::Record);
            return;
        }
        let Some(solved) = self.solved() else { return };
        let started = self.jobs.start(JobKind::Record, move |job| match Recording::record(&solved, job) {
            Ok(Some(recording)) => job.send(JobResult::Recording(Arc::new(recording))),
            Ok(None) => {}
            Err(error) => job.send(JobResult::failed(&error)),
        });
        self.report(started);
    }
}
