//! All tests that go through the public door, in one binary.

mod loader;
