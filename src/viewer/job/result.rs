//! Results of jobs.

use std::path::PathBuf;
use std::sync::Arc;

use crate::viewer::solution::meter::{Grid, Reading};
use crate::viewer::solution::patch_view::ChosenPatchView;
use crate::viewer::solution::recording::Recording;
use crate::viewer::solution::traced_view::TracedView;

/// A result that a job sends to the window.
pub enum JobResult {
    /// A reading of the lux meter.
    Reading(Box<Reading>),
    /// A measured grid.
    Grid(Box<Grid>),
    /// The view from a patch.
    PatchView(Arc<ChosenPatchView>),
    /// The recording of a bake.
    Recording(Arc<Recording>),
    /// The traced view after one more pass.
    TracedView(Box<TracedView>),
    /// A file that has been written.
    Written(PathBuf),
    /// The job has failed, with a message for the user.
    Failed(String),
}

impl JobResult {
    /// Returns the failure with the causes of `error`.
    #[must_use]
    pub fn failed(error: &anyhow::Error) -> Self {
        Self::Failed(format!("{error:#}"))
    }
}

impl From<anyhow::Result<PathBuf>> for JobResult {
    fn from(written: anyhow::Result<PathBuf>) -> Self {
        written.map_or_else(|error| Self::failed(&error), Self::Written)
    }
}
