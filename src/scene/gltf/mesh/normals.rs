//! How a transform turns normals.

use glam::DMat3;

/// Inverse transpose up to scale, by cofactors: it also serves transforms that flatten an object.
pub(crate) fn normal_matrix(linear: DMat3) -> DMat3 {
    let DMat3 { x_axis: x, y_axis: y, z_axis: z } = linear;
    let sign = if linear.determinant() < 0.0 { -1.0 } else { 1.0 };
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign
}
