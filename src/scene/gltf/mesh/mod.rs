//! Meshes: primitives are read through accessors, deformed by morph targets and skins, and placed in the world.
//!
//! `meshes` goes through the primitives of a node: `geometry` reads one (`attributes`, `topology`, `draco`, `morph`),
//! `skin` deforms it, `placement` transforms it into the scene.

mod attributes;
mod draco;
mod geometry;
pub(super) mod meshes;
mod morph;
mod placement;
mod skin;
mod topology;
