//! Floor 1: the GPU device and nothing else: adapter and tier, shader modules, read-back, timestamps.
//!
//! The code that draws is on higher floors: `render::scene` has the lit scene on the device, and each pass
//! declares its own shader. wgpu is used here, in `form_factor::hemicube`, `render` and `viewer`, and nowhere else.

pub mod context;
pub mod error;
pub mod readback;
pub mod shader;
pub mod shader_library;
mod shader_module;
mod software;
mod stitched;
pub mod stopwatch;
pub mod tier;

pub use context::Gpu;
pub use error::GpuError;
pub use stopwatch::Stopwatch;
pub use tier::Tier;
