//! Meshes: attributes are read through accessors, brought into their rest pose, and placed in the world.

mod attributes;
mod draco;
mod geometry;
mod influences;
pub(super) mod meshes;
mod morph;
mod normals;
mod placement;
mod skin;
mod topology;
