//! The worker: a thread that loads a scene and bakes it.
//!
//! The thread uploads triangles and light to the window's device, so that no frame waits for an upload. While the
//! window draws, the worker pauses ([`Worker::pause`]) between two of its small steps.

mod runner;
mod shared;
mod worker_thread;

pub use runner::Task;
pub use worker_thread::Worker;
