//! A file taken apart: its container, the bytes behind its URIs, its buffer views and accessors, every index checked.

pub(super) mod accessor;
mod container;
pub(super) mod document;
pub(super) mod extension;
mod meshopt;
pub(super) mod resource;
