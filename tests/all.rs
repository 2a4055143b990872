//! All tests that go through the public door, in one binary.
#![allow(clippy::unwrap_used, missing_docs)]

mod support;

mod assets;
mod builtin;
mod floors;
mod loader;
mod meshing;
mod pictures;
mod radiosity;
mod render_command;
mod shadows;
