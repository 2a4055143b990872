//! State that the worker's thread and the window share.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use crate::base::progress::{Cancel, Gate, Stage};

/// State that the worker's thread and the window share.
pub(super) struct Shared {
    began: Instant,
    /// Gate that the work passes between steps; closed while the window draws.
    pub gate: Gate,
    pub cancel: Cancel,
    /// The stage and its completed fraction.
    progress: Mutex<(Stage, f32)>,
    /// Unshot share at which the bake ends.
    threshold: Mutex<f32>,
    /// Seconds since the beginning, and unshot share of the light.
    curve: Mutex<Vec<[f32; 2]>>,
    /// The time from which new light is to be uploaded; `None` until the last light has been drawn.
    light_due: Mutex<Option<Instant>>,
}

impl Shared {
    pub fn new(light_due: Option<Instant>) -> Arc<Self> {
        Arc::new(Self {
            began: Instant::now(),
            gate: Gate::default(),
            cancel: Cancel::default(),
            progress: Mutex::new((Stage::Load, 0.0)),
            threshold: Mutex::new(1.0),
            curve: Mutex::default(),
            light_due: Mutex::new(light_due),
        })
    }

    /// Stores the progress. Progress of the solver also adds a point to the curve.
    pub fn report(&self, stage: Stage, done: f32) {
        *lock(&self.progress) = (stage, done);
        if stage == Stage::Solve {
            // Progressive refinement reports its progress as log(unshot) / log(threshold).
            let unshot = lock(&self.threshold).powf(done);
            lock(&self.curve).push([self.began.elapsed().as_secs_f32(), unshot]);
        }
    }

    pub fn progress(&self) -> (Stage, f32) {
        *lock(&self.progress)
    }

    pub fn curve(&self) -> Vec<[f32; 2]> {
        lock(&self.curve).clone()
    }

    pub fn set_threshold(&self, threshold: f32) {
        *lock(&self.threshold) = threshold;
    }

    pub fn is_light_due(&self) -> bool {
        lock(&self.light_due).is_some_and(|due| due <= Instant::now())
    }

    /// Holds back the next upload until the window has drawn the light that is uploaded now.
    pub fn wait_for_window(&self) {
        *lock(&self.light_due) = None;
    }

    /// Called after the window has drawn the last light. The next upload is due after `pause`.
    pub fn request_light(&self, pause: Duration) {
        lock(&self.light_due).get_or_insert_with(|| Instant::now() + pause);
    }
}

/// Locks a mutex. Its value is valid even after a panic of the other thread, since every change is a single assignment.
pub(super) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_ends_at_the_threshold() {
        let shared = Shared::new(None);
        shared.set_threshold(0.01);
        shared.report(Stage::Direct, 1.0);
        shared.report(Stage::Solve, 0.5);
        shared.report(Stage::Solve, 1.0);
        let unshot: Vec<f32> = shared.curve().iter().map(|point| point[1]).collect();
        assert!(unshot.len() == 2 && (unshot[0] - 0.1).abs() < 1e-6 && (unshot[1] - 0.01).abs() < 1e-6, "{unshot:?}");
    }
}
