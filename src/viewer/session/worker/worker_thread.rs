//! The worker as seen from the window.

use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use anyhow::Context;
use winit::event_loop::EventLoopProxy;

use super::runner::{Runner, Task};
use super::shared::Shared;
use crate::base::progress::Stage;
use crate::gpu::Gpu;
use crate::viewer::background::lower_priority;
use crate::viewer::session::user_event::UserEvent;

/// A thread that loads or bakes.
pub struct Worker {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

/// Guard that pauses the work until it is dropped.
pub struct Paused(Arc<Shared>);

impl Drop for Paused {
    fn drop(&mut self) {
        self.0.gate.open();
    }
}

impl Worker {
    /// Starts a thread for `task`. `gpu` is the window's device, `run` the number in the events of the thread.
    ///
    /// # Errors
    /// Returns an error if the system cannot start a thread.
    pub fn start(run: u32, task: Task, gpu: Arc<Gpu>, window: EventLoopProxy<UserEvent>) -> anyhow::Result<Self> {
        let shared = Shared::new(Some(Instant::now()));
        let runner = Runner::new(run, gpu, window, Arc::clone(&shared));
        let work = move || {
            lower_priority();
            runner.run(task);
        };
        let thread = std::thread::Builder::new().name("bake".to_owned()).spawn(work);
        Ok(Self { shared, thread: Some(thread.context("cannot start the bake")?) })
    }

    /// Returns the stage and its completed fraction, 0..1.
    #[must_use]
    pub fn progress(&self) -> (Stage, f32) {
        self.shared.progress()
    }

    /// Returns the convergence of the bake: seconds since the beginning, and unshot share of the light.
    #[must_use]
    pub fn curve(&self) -> Vec<[f32; 2]> {
        self.shared.curve()
    }

    /// Cancels the work, which ends soon. The light that is solved so far remains.
    pub fn cancel(&self) {
        self.shared.cancel.cancel();
    }

    /// Returns true if the work has been cancelled.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.shared.cancel.is_cancelled()
    }

    /// Returns true if the thread has ended.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.thread.as_ref().is_none_or(JoinHandle::is_finished)
    }

    /// Requests an upload of new light after `pause`. Called once the last light has been drawn.
    pub fn request_light(&self, pause: Duration) {
        self.shared.request_light(pause);
    }

    /// Pauses the work until the result is dropped.
    #[must_use]
    pub fn pause(&self) -> Paused {
        self.shared.gate.close();
        Paused(Arc::clone(&self.shared))
    }
}

impl Drop for Worker {
    /// Waits for the thread, since the device must outlive its work.
    fn drop(&mut self) {
        self.cancel();
        self.shared.gate.open();
        if let Some(thread) = self.thread.take() {
            // The panic of a thread has been printed already.
            let _ = thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_pauses_and_resumes() {
        let shared = Shared::new(None);
        let worker = Worker { shared: Arc::clone(&shared), thread: None };
        let paused = worker.pause();
        let (sender, done) = std::sync::mpsc::channel();
        let work = std::thread::spawn(move || {
            shared.gate.pass();
            sender.send(()).expect("the test waits");
        });
        assert!(done.recv_timeout(Duration::from_millis(50)).is_err(), "the gate let it pass");
        drop(paused);
        assert!(done.recv_timeout(Duration::from_secs(5)).is_ok());
        work.join().expect("no panic");
    }

    #[test]
    fn dropping_a_paused_worker_ends_its_thread() {
        let shared = Shared::new(None);
        let for_thread = Arc::clone(&shared);
        let thread = std::thread::spawn(move || {
            while !for_thread.cancel.is_cancelled() {
                for_thread.gate.pass();
                std::thread::yield_now();
            }
        });
        let worker = Worker { shared, thread: Some(thread) };
        std::mem::forget(worker.pause());
        drop(worker);
    }
}
