//! Floor 0: what every other floor speaks in. No scene, no GPU, no files.

pub mod colour;
pub mod ids;
pub mod progress;
pub mod sampling;
