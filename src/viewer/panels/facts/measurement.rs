//! Facts about measurements.

use std::sync::Arc;

use crate::viewer::solution::meter::{Grid, Reading};
use crate::viewer::solution::patch_view::ChosenPatchView;

/// Results of measurements.
#[derive(Clone, Copy, Default)]
pub struct MeasurementFacts<'a> {
    /// The last reading.
    pub last: Option<&'a Reading>,
    /// Readings that the user has pinned.
    pub pins: &'a [Reading],
    /// The last grid.
    pub grid: Option<&'a Grid>,
    /// The view from the chosen patch.
    pub patch_view: Option<&'a Arc<ChosenPatchView>>,
    /// True while a measurement is running.
    pub is_busy: bool,
}
