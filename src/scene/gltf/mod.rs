//! The only place that knows glTF input: a .gltf or .glb file becomes a validated [`Scene`](crate::scene::Scene).
//!
//! The route, which `load` follows: bytes -> `file` (container, buffers, accessors, checked look-ups) -> `node` (the tree,
//! flattened, held against a `budget`) -> `material` and `texture` -> `populate` (`mesh`: attributes in their rest pose,
//! placed in the world; `light` and `camera`) -> light groups. The gltf crate gives the typed JSON only: its accessors and
//! its importer can panic on broken files, ours check every range, so that any file either loads or ends in one
//! [`LoadError`].
//!
//! Deliberately absent: animation. Skins and morph targets are shown as the file's nodes and weights place them.
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
