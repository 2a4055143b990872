//! Progress reports of long work, its cancellation, and its pauses while the viewer draws a frame.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex};

/// Stages of a bake, in the order in which they run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Reading and checking the file.
    Load,
    /// Division of the scene into elements and patches.
    Mesh,
    /// Direct light, by ray tracing.
    Direct,
    /// Progressive refinement; the reported progress is the share of the light that has been shot.
    Solve,
    /// Indirect light at the vertices.
    Gather,
    /// Ray tracing of a picture or a measurement.
    Trace,
}

impl Stage {
    /// Returns the name of the stage in a progress bar.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Stage::Load => "loading",
            Stage::Mesh => "meshing",
            Stage::Direct => "direct light",
            Stage::Solve => "radiosity",
            Stage::Gather => "vertex light",
            Stage::Trace => "tracing rays",
        }
    }
}

/// Interface between long work and its caller.
///
/// The work calls [`Progress::report`] and [`Progress::rest`] between small steps. When [`Progress::is_cancelled`]
/// returns true, it stops and returns what it has computed so far.
pub trait Progress: Sync {
    /// Reports that the share `done` of the stage's work, 0..1, is complete.
    fn report(&self, stage: Stage, done: f32);
    /// Returns true if the work must stop at its next step and return its partial result.
    fn is_cancelled(&self) -> bool;
    /// Blocks while the caller needs the processor, as the viewer does while it draws.
    fn rest(&self) {}
}

/// A [`Progress`] that ignores all reports and never cancels.
pub struct Unwatched;

impl Progress for Unwatched {
    fn report(&self, _: Stage, _: f32) {}
    fn is_cancelled(&self) -> bool {
        false
    }
}

/// A flag that cancels work; once set, it stays set.
#[derive(Debug, Default)]
pub struct Cancel(AtomicBool);

impl Cancel {
    /// Sets the flag.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Returns true if the flag is set.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Pauses a working thread between two of its steps while another thread draws: [`Gate::pass`] blocks while the gate is
/// closed.
#[derive(Debug, Default)]
pub struct Gate {
    closed: Mutex<bool>,
    opened: Condvar,
}

impl Gate {
    /// Closes the gate: the work pauses at its next step.
    pub fn close(&self) {
        *self.lock() = true;
    }

    /// Opens the gate: the work continues.
    pub fn open(&self) {
        *self.lock() = false;
        self.opened.notify_all();
    }

    /// Blocks while the gate is closed.
    pub fn pass(&self) {
        let mut closed = self.lock();
        while *closed {
            closed = self.opened.wait(closed).unwrap_or_else(std::sync::PoisonError::into_inner);
        }
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, bool> {
        self.closed.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }
}
