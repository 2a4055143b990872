//! All tests that go through the public door, in one binary.
#![allow(clippy::unwrap_used, missing_docs)]

mod support;

mod meshing;
mod pictures;
mod radiosity;
