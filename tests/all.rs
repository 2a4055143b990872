//! All tests that go through the public door, in one binary.
#![allow(clippy::unwrap_used, missing_docs)]

mod support;

mod assets;
mod builtin;
mod comparison;
mod floors;
mod form_factors;
mod gathering;
mod lightmap;
mod loader;
mod meshing;
mod mirrors;
mod noise;
mod panels;
mod pictures;
mod radiosity;
mod raytrace;
mod render_command;
mod shaders;
mod shadows;
mod stopped;
mod twins;
mod viewer;
