//! Writes a bake, or a plain scene, as a standard .glb, and takes the light of a bake out of a loaded scene.
//!
//! Light is stored twice. It is stored exactly, as float vertex attributes `_IRRADIANCE_DIRECT_g` and
//! `_IRRADIANCE_INDIRECT_g` (lux per channel, g counts the light groups), which other programs have to ignore. For
//! other programs it is stored at one exposure, as vertex colours of unlit materials, which every viewer shows. Data
//! for which glTF has no property is in `extras`: `light_groups` and `exposure_ev` of the glTF scene, `light_group` of
//! lights and emissive materials, `paint` of materials (their original values), `back_side` and `elements` of
//! primitives (`elements.rs`). Vertex colours of the scene become `_COLOR` and `_ALPHA`. Programs that read light from
//! a texture get a separate file (`moz_lightmap.rs`).
//!
//! Light is restored exactly, and so are meshes whose nodes are not rotated. Others are restored within rounding,
//! because each mesh is written in the space of its node, where other programs expect it. Reading files is deliberately
//! absent: it is the task of the loader ([`crate::scene::gltf`]).
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
