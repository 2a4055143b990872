//! The open scene, its light, its file, and the worker that loads and bakes it.

mod default_sky;
mod state;
pub(super) mod worker;

pub mod light_state;

pub(super) mod advice;
pub(super) mod file_watch;
pub(super) mod open_scene;
pub(super) mod source;
pub(super) mod user_event;

pub(super) use default_sky::NOTE as DEFAULT_SKY_NOTE;
pub(super) use state::{Outcome, Session};
