//! Helpers that several test files share.

pub mod device;
pub mod quads;
pub mod scenes;
pub mod screen;
pub mod snapshot;
pub mod sources;
