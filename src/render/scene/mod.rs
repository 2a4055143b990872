//! The lit scene on the device: vertices, triangles in batches of one material, textures, and the light of the vertices.
//!
//! A [`SceneBuffers`] holds all of it; [`view`] selects what a camera may see, [`part`] what remains when instances are
//! hidden, and [`tiled_mesh`] draws a bake with its coarse mesh. The passes above read these buffers and own none of them.

pub mod buffers;
pub mod materials;
mod mip;
mod order;
mod part;
mod textures;
pub mod tiled_mesh;
pub mod tiles;
pub mod vertex_light;
mod vertex_order;
pub mod view;

pub use buffers::SceneBuffers;
