//! The jobs that are running.

use std::collections::HashMap;
use std::sync::Arc;
use std::thread::JoinHandle;

use anyhow::Context;

use super::handle::{Controls, Deliver, JobHandle};
use super::result::JobResult;
use crate::viewer::background::lower_priority;

/// Kinds of jobs. At most one job of each kind runs: a new one ends the previous one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum JobKind {
    /// Measures a point or a grid.
    Measure,
    /// Computes the view from a patch.
    PatchView,
    /// Records the bake.
    Record,
    /// Traces the view.
    TraceView,
    /// Writes a file.
    Write,
}

impl JobKind {
    const ALL: [Self; 5] = [Self::Measure, Self::PatchView, Self::Record, Self::TraceView, Self::Write];
}

/// All running jobs.
pub struct Jobs {
    deliver: Deliver,
    last_number: u32,
    running: HashMap<JobKind, Job>,
    /// Cancelled jobs, dropped when they have ended.
    retired: Vec<Job>,
}

struct Job {
    number: u32,
    controls: Arc<Controls>,
    thread: Option<JoinHandle<()>>,
}

impl Jobs {
    /// Creates an empty list. `deliver` is called with the number and a result of a job, in the thread of the job.
    #[must_use]
    pub fn new(deliver: impl Fn(u32, JobResult) + Send + Sync + 'static) -> Self {
        Self { deliver: Arc::new(deliver), last_number: 0, running: HashMap::new(), retired: Vec::new() }
    }

    /// Starts a job, and ends the running one of this kind.
    ///
    /// # Errors
    /// Returns an error if the system cannot start a thread.
    pub fn start(&mut self, kind: JobKind, work: impl FnOnce(&JobHandle) + Send + 'static) -> anyhow::Result<()> {
        self.end(kind);
        self.last_number += 1;
        let controls = Arc::new(Controls::default());
        let job =
            JobHandle { number: self.last_number, controls: Arc::clone(&controls), deliver: Arc::clone(&self.deliver) };
        let thread = std::thread::Builder::new().name("job".to_owned()).spawn(move || {
            lower_priority();
            work(&job);
        });
        let thread = Some(thread.context("cannot start a thread")?);
        self.running.insert(kind, Job { number: self.last_number, controls, thread });
        Ok(())
    }

    /// Ends the job of a kind, if one runs.
    pub fn end(&mut self, kind: JobKind) {
        self.retired.retain(|job| !job.is_finished());
        if let Some(job) = self.running.remove(&kind) {
            job.controls.end();
            self.retired.push(job);
        }
    }

    /// Ends all jobs.
    pub fn end_all(&mut self) {
        JobKind::ALL.into_iter().for_each(|kind| self.end(kind));
    }

    /// Returns true if a job of this kind is running.
    #[must_use]
    pub fn is_running(&self, kind: JobKind) -> bool {
        self.running.get(&kind).is_some_and(|job| !job.is_finished())
    }

    /// Returns true if the job with this number has not been ended, so that its results are still used.
    #[must_use]
    pub fn is_current(&self, number: u32) -> bool {
        self.running.values().any(|job| job.number == number)
    }

    /// Pauses all jobs until [`Jobs::resume`].
    pub fn pause(&self) {
        self.running.values().for_each(|job| job.controls.gate.close());
    }

    /// Resumes all jobs.
    pub fn resume(&self) {
        self.running.values().for_each(|job| job.controls.gate.open());
    }
}

impl Job {
    fn is_finished(&self) -> bool {
        self.thread.as_ref().is_none_or(JoinHandle::is_finished)
    }
}

impl Drop for Job {
    /// Waits for the thread, since the device must outlive its work.
    fn drop(&mut self) {
        self.controls.end();
        if let Some(thread) = self.thread.take() {
            // The panic of a thread has been printed already.
            let _ = thread.join();
        }
    }
}
