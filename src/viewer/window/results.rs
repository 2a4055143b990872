//! Results of jobs about the open scene.

use std::sync::Arc;

use crate::viewer::solution::meter::{Grid, Reading};
use crate::viewer::solution::patch_view::ChosenPatchView;
use crate::viewer::solution::recording::Recording;

/// Results of jobs about the open scene.
#[derive(Default)]
pub struct Results {
    /// Measurements of the lux meter.
    pub measurements: Measurements,
    /// The view from the chosen patch.
    pub patch_view: Option<Arc<ChosenPatchView>>,
    /// The recording of the bake.
    pub recording: Option<Arc<Recording>>,
}

/// Measurements of the lux meter.
#[derive(Default)]
pub struct Measurements {
    /// The last reading.
    pub last: Option<Reading>,
    /// Readings that the user has pinned.
    pub pins: Vec<Reading>,
    /// The last grid.
    pub grid: Option<Grid>,
}

impl Measurements {
    /// Pins the last reading.
    pub fn pin(&mut self) {
        self.pins.extend(self.last.take());
    }

    /// Returns all readings, the pinned ones first.
    #[must_use]
    pub fn readings(&self) -> Vec<Reading> {
        self.pins.iter().chain(&self.last).cloned().collect()
    }
}
