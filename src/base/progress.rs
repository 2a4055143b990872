//! Long work tells how far it is, can be cancelled, and makes room for a frame to be drawn.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex};

/// A stage of the bake, in the order in which they run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Reading and checking the file.
    Load,
    /// Elements and patches.
    Mesh,
    /// Direct light by rays.
    Direct,
    /// Progressive refinement: the done share is the share of light that has been shot.
    Solve,
    /// Indirect light at the vertices.
    Gather,
    /// Rays of a picture or a measurement.
    Trace,
}

impl Stage {
    /// What a progress bar calls this stage.
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

/// What long work reports to and asks of whoever started it.
///
/// The work calls [`Progress::report`] and [`Progress::rest`] between small steps and stops where
/// [`Progress::is_cancelled`], keeping what it has.
pub trait Progress: Sync {
    /// `done` of the stage's work, 0..1.
    fn report(&self, stage: Stage, done: f32);
    /// The work shall end soon and keep what is solved.
    fn is_cancelled(&self) -> bool;
    /// Blocks while somebody else needs the machine (the viewer while it draws).
    fn rest(&self) {}
}

/// Nobody watches and nobody cancels.
pub struct Unwatched;

impl Progress for Unwatched {
    fn report(&self, _: Stage, _: f32) {}
    fn is_cancelled(&self) -> bool {
        false
    }
}

/// A flag that asks for the end of a piece of work; set once.
#[derive(Debug, Default)]
pub struct Cancel(AtomicBool);

impl Cancel {
    /// Asks the work to end.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// The end was asked for.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Lets a drawing thread hold a working thread between two steps: the work rests while the gate is closed.
#[derive(Debug, Default)]
pub struct Gate {
    closed: Mutex<bool>,
    opened: Condvar,
}

impl Gate {
    /// The work pauses at its next step.
    pub fn close(&self) {
        *self.lock() = true;
    }

    /// The work goes on.
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
