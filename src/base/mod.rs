//! Floor 0: types and functions that every other floor uses. They depend on neither scene nor GPU.

pub mod bounds;
pub mod colour;
pub mod fingerprint;
pub mod ids;
pub mod output;
pub mod progress;
pub mod sampling;
pub mod triangle;
