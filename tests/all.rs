//! All tests that go through the public door, in one binary.

mod support;

mod assets;
mod builtin;
mod pictures;
