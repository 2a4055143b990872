//! Loads and bakes in a thread of its own, and tells the window what is new.
//!
//! The thread uploads meshes and light to the window's device itself, so that no frame has to wait for that. While the
//! window draws, it holds the work ([`Worker::hold`]); the work rests between two of its small steps.

mod news;
mod runner;
mod source;

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use anyhow::Context;
use winit::event_loop::EventLoopProxy;

use crate::base::progress::{Cancel, Gate, Stage};
use crate::gpu::Gpu;
use crate::viewer::background::give_way;

pub use news::{Event, Job, Loaded, Mesh, News};
use runner::Runner;
pub use source::Source;

/// A job that runs.
pub struct Worker {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

/// What the window and the thread both touch.
struct Shared {
    began: Instant,
    gate: Gate,
    cancel: Cancel,
    /// Stage and its done share.
    progress: Mutex<(Stage, f32)>,
    /// Share of unshot light at which the bake ends.
    threshold: Mutex<f32>,
    /// Seconds since the beginning, and share of the light that is unshot.
    curve: Mutex<Vec<[f32; 2]>>,
    /// From when on new light is welcome; none while the last is not on the screen.
    light_wanted: Mutex<Option<Instant>>,
}

impl Shared {
    fn new(light_wanted: Option<Instant>) -> Arc<Self> {
        Arc::new(Self {
            began: Instant::now(),
            gate: Gate::default(),
            cancel: Cancel::default(),
            progress: Mutex::new((Stage::Load, 0.0)),
            threshold: Mutex::new(1.0),
            curve: Mutex::default(),
            light_wanted: Mutex::new(light_wanted),
        })
    }

    fn report(&self, stage: Stage, done: f32) {
        *lock(&self.progress) = (stage, done);
        if stage == Stage::Solve {
            // Shooting reports on a logarithmic scale that ends at the threshold.
            let unshot = lock(&self.threshold).powf(done);
            lock(&self.curve).push([self.began.elapsed().as_secs_f32(), unshot]);
        }
    }
}

/// Holds the work until it is dropped.
pub struct Held(Arc<Shared>);

impl Drop for Held {
    fn drop(&mut self) {
        self.0.gate.open();
    }
}

impl Worker {
    /// Starts a thread for `job`; `gpu` is the window's device.
    ///
    /// # Errors
    /// The system gives no thread.
    pub fn start(number: u32, job: Job, gpu: Arc<Gpu>, window: EventLoopProxy<News>) -> anyhow::Result<Self> {
        let shared = Shared::new(Some(Instant::now()));
        let runner =
            Runner { number, gpu, window, shared: Arc::clone(&shared), mesh: Mutex::default(), told: Mutex::new(None) };
        let work = move || {
            give_way();
            runner.run(job);
        };
        let thread = std::thread::Builder::new().name("bake".to_owned()).spawn(work);
        Ok(Self { shared, thread: Some(thread.context("cannot start the bake")?) })
    }

    /// Stage and its done share, 0..1.
    #[must_use]
    pub fn progress(&self) -> (Stage, f32) {
        *lock(&self.shared.progress)
    }

    /// The bake so far: seconds since the beginning, and share of the light that is unshot.
    #[must_use]
    pub fn curve(&self) -> Vec<[f32; 2]> {
        lock(&self.shared.curve).clone()
    }

    /// Asks the work to end soon and to keep what is solved.
    pub fn cancel(&self) {
        self.shared.cancel.cancel();
    }

    /// The end has been asked for.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.shared.cancel.is_cancelled()
    }

    /// The thread has ended.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.thread.as_ref().is_none_or(JoinHandle::is_finished)
    }

    /// The last light is on the screen; the next one is welcome after `pause`.
    pub fn ask_for_light(&self, pause: Duration) {
        lock(&self.shared.light_wanted).get_or_insert_with(|| Instant::now() + pause);
    }

    /// The work rests until the result is dropped.
    #[must_use]
    pub fn hold(&self) -> Held {
        self.shared.gate.close();
        Held(Arc::clone(&self.shared))
    }
}

impl Drop for Worker {
    /// Waits for the thread: a device must not be torn down while it works.
    fn drop(&mut self) {
        self.cancel();
        self.shared.gate.open();
        if let Some(thread) = self.thread.take() {
            // A panic of the thread has been printed already.
            let _ = thread.join();
        }
    }
}

/// The values behind a lock are whole at any time: a thread that panicked leaves nothing half done.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_rests_while_it_is_held_and_goes_on_afterwards() {
        let shared = Shared::new(None);
        let worker = Worker { shared: Arc::clone(&shared), thread: None };
        let held = worker.hold();
        let (told, done) = std::sync::mpsc::channel();
        let work = std::thread::spawn(move || {
            shared.gate.pass();
            told.send(()).expect("somebody listens");
        });
        assert!(done.recv_timeout(Duration::from_millis(50)).is_err(), "the gate let it pass");
        drop(held);
        assert!(done.recv_timeout(Duration::from_secs(5)).is_ok());
        work.join().expect("no panic");
    }

    #[test]
    fn a_worker_that_is_dropped_ends_its_thread_even_while_it_is_held() {
        let shared = Shared::new(None);
        let for_thread = Arc::clone(&shared);
        let thread = std::thread::spawn(move || {
            while !for_thread.cancel.is_cancelled() {
                for_thread.gate.pass();
                std::thread::yield_now();
            }
        });
        let worker = Worker { shared, thread: Some(thread) };
        std::mem::forget(worker.hold());
        drop(worker);
    }

    #[test]
    fn the_curve_ends_at_the_threshold() {
        let shared = Shared::new(None);
        *lock(&shared.threshold) = 0.01;
        shared.report(Stage::Direct, 1.0);
        shared.report(Stage::Solve, 0.5);
        shared.report(Stage::Solve, 1.0);
        let unshot: Vec<f32> = lock(&shared.curve).iter().map(|point| point[1]).collect();
        assert!(unshot.len() == 2 && (unshot[0] - 0.1).abs() < 1e-6 && (unshot[1] - 0.01).abs() < 1e-6, "{unshot:?}");
    }
}
