//! All tests of the public interface, in one binary.
#![allow(clippy::unwrap_used, missing_docs)]

mod support;

mod documents;
mod floors;
mod lightmap;
mod mirrors;
mod pictures;
mod raytrace;
mod render_command;
mod scene;
mod shaders;
mod shadows;
mod solver;
mod viewer;
