//! Floor 2: rays on the CPU: nearest hits and how much light passes between two points.
//!
//! Used for direct light, the hemisphere method, collision in the viewer and ray-traced truth.

pub mod bvh;
mod wide;

pub use bvh::{Hit, Tracer};
