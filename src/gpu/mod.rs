//! Floor 1: the GPU device and nothing else: the adapter, shader modules, read-back, timestamps.
//!
//! What is drawn lives above: the lit scene on the device in `render::scene`, each pass with its own shader beside it.
//! wgpu is named here, in `form_factor::hemicube`, `render` and `viewer`, and nowhere else.

pub mod context;
pub mod readback;
pub mod shader;
pub mod stopwatch;

pub use context::{Gpu, GpuError};
pub use stopwatch::Stopwatch;
