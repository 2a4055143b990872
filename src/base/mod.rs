//! Floor 0: what every other floor speaks in. No scene, no GPU.

pub mod bounds;
pub mod colour;
pub mod fingerprint;
pub mod ids;
pub mod output;
pub mod progress;
pub mod sampling;
pub mod triangle;
