//! The lit scene on the device: vertices, triangles in batches of one material, textures, and the light of the
//! vertices.
//!
//! A [`SceneBuffers`] holds all of it. `selection` makes the part that a camera may see, or that remains when instances
//! are hidden. [`tiled_mesh`] draws a bake with its coarse mesh. The passes read these buffers and own none of them.

pub mod buffers;
pub mod cull_view;
pub mod draw_batch;
mod draw_order;
pub mod gpu_vertex;
pub mod materials;
mod mip;
mod pre_exposure;
mod selection;
mod textures;
pub mod tiled_mesh;
pub mod tiles;
pub mod vertex_light;
mod vertex_order;

pub use buffers::SceneBuffers;
