//! The orientation of a node without its scale, shear and mirroring, for lights and cameras.

use glam::{DAffine3, DMat3, DVec3};

/// Right-handed orthonormal axes: the node's +Z exactly, and its +Y made perpendicular to it.
pub(crate) fn frame(world_from_node: DAffine3) -> DMat3 {
    let z = world_from_node.matrix3.z_axis.try_normalize().unwrap_or(DVec3::Z);
    let across = world_from_node.matrix3.y_axis.cross(z);
    let x = across.try_normalize().unwrap_or_else(|| z.any_orthonormal_vector());
    DMat3::from_cols(x, z.cross(x), z)
}
