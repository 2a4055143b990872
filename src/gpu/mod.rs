//! Floor 2: the GPU device and what the hemicube and the picture both draw.
//!
//! wgpu is met here, in `form_factor::hemicube`, `render` and `viewer`, and nowhere else.

pub mod context;
pub mod readback;
pub mod shaders;

pub use context::{Gpu, GpuError};
