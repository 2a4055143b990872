//! Floor 2: the GPU device and what the hemicube and the picture both draw.
//!
//! wgpu is met here, in `form_factor::hemicube`, `render` and `viewer`, and nowhere else.

mod coarse;
pub mod context;
pub mod material_buffers;
pub mod mip;
pub mod readback;
pub mod scene_buffers;
mod scene_order;
mod scene_part;
pub mod scene_view;
pub mod shaders;
pub mod stopwatch;
pub mod targets;
pub mod textures;
pub mod tiled_mesh;
pub mod tiles;
pub mod vertex_light;
mod vertex_order;

pub use context::{Gpu, GpuError};
pub use scene_buffers::SceneBuffers;
pub use stopwatch::Stopwatch;
