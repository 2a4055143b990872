//! Writes a bake, or a plain scene, as a standard .glb, and takes the light of a bake out of a loaded scene.
//!
//! Light is stored twice: exactly, as float vertex attributes `_IRRADIANCE_DIRECT_g` and `_IRRADIANCE_INDIRECT_g` (lux
//! per channel, g counts the light groups), which other programs have to ignore; and for other programs, at one
//! exposure, as vertex colours of unlit materials, which every viewer shows. What glTF has no words for lies in
//! `extras`: `light_groups` and `exposure_ev` of the glTF scene, `light_group` of lights and emissive materials,
//! `paint` of materials (what they were), `back_side` and `elements` of primitives (`elements.rs`); vertex colours of
//! the scene become `_COLOR` and `_ALPHA`. Programs that read light from a texture get a file of their own
//! (`moz_lightmap.rs`).
//!
//! Light comes back bit by bit, and so do meshes whose nodes are not rotated; others within rounding, because each mesh
//! is written in the space of its node, where other programs expect it. Deliberately absent: reading files, which is
//! the loader's part ([`crate::scene::gltf`]).
//!
//! * `write`: the functions to call. `document`: the whole file. `hierarchy`, `node`, `mesh`, `material`, `binary`: its
//!   parts.
//! * `light_storage`: where light is stored. `unlit`: vertex colours that show it. `moz_lightmap`: light as a texture.
//! * `read`: light out of a loaded scene. `elements`: bisection trees and pairs of fronts and backs, written and read.
//!
//! Source: glTF 2.0 specification, sections 3 (concepts) and 4 (GLB file format).

mod binary;
mod document;
mod elements;
mod hierarchy;
mod json;
mod light_storage;
mod material;
mod mesh;
mod moz_lightmap;
mod node;
mod read;
mod unlit;
mod write;

#[cfg(test)]
mod tests;

pub use read::from_scene;
pub use write::{lightmap_to_glb, scene_to_glb, to_glb, write, write_lightmap};
