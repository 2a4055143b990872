//! The node tree: every visible node with its transform to the world, and the places of instanced meshes.

pub(super) mod frame;
pub(super) mod instancing;
pub(super) mod tree;
