//! The glTF loader: reads a .gltf or .glb file into a validated [`Scene`](crate::scene::Scene).
//!
//! `load` runs these steps, each in a module of its own:
//!
//! | module | step |
//! |---|---|
//! | `file` | bytes to JSON, buffers and accessors; checks every index and every range |
//! | `node` | the node tree to a list of nodes with their world transforms; `budget` bounds the size of the scene |
//! | `material`, `texture` | materials, variants, decoded images |
//! | `mesh` | primitives to triangles in their rest pose, placed in the world |
//! | `light`, `camera` | lights, cameras, light groups |
//!
//! `populate` adds the content of the nodes to the scene; `scene_choice` selects one of the file's scenes.
//!
//! Of the gltf crate only the typed JSON is used: its accessors and its importer can panic on broken files. Here every
//! file either loads or yields one [`LoadError`].
//!
//! Not supported: animation. Skins and morph targets are shown in the pose of the file's nodes and weights.
//!
//! Source: Khronos Group, "glTF 2.0 Specification" (ISO/IEC 12113:2022) and its extension registry.

mod budget;
mod camera;
mod error;
mod file;
#[cfg(test)]
mod fixture;
mod light;
mod load;
mod material;
mod mesh;
mod node;
mod populate;
mod scene_choice;
mod texture;

pub use error::{Cause, LoadError};
pub use load::{LoadOptions, from_slice, from_slice_with, load, load_with};
