//! Transformation of normals.

use glam::DMat3;

/// Matrix that transforms normals: the inverse transpose of `linear` up to a positive factor. It is computed from
/// cofactors, so it exists for singular transforms, too.
pub(crate) fn normal_matrix(linear: DMat3) -> DMat3 {
    let DMat3 { x_axis: x, y_axis: y, z_axis: z } = linear;
    let sign = if linear.determinant() < 0.0 { -1.0 } else { 1.0 };
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign
}
