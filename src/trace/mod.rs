//! Floor 2: ray queries on the CPU: the nearest hit, and the transmittance between two points.
//!
//! Direct light, the hemisphere method, collision in the viewer and the ray tracers use it. `tracer`: queries on a
//! scene, with alpha. `wide/`: the bounding volume hierarchy.

mod tracer;
mod wide;

pub use tracer::{Hit, Tracer};
