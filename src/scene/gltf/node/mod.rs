//! The node tree: the visible nodes with their world transforms, and the transforms of instanced meshes.

pub(super) mod instancing;
pub(super) mod tree;
