//! The parts of a file: container, external resources, buffer views, accessors. Every index and every range is checked.

pub(super) mod accessor;
mod container;
pub(super) mod document;
pub(super) mod extension;
mod meshopt;
pub(super) mod resource;
