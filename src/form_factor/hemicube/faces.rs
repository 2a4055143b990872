//! The five faces of a hemicube: their projections and their rectangles in the atlas.

use glam::{Mat4, Vec3, Vec4};

use super::layout::Layout;
use crate::base::sampling::{hash, tangent_frame, unit_float};
use crate::form_factor::Viewpoint;

/// Number of faces of a hemicube: the top and four half sides.
pub(super) const NUM_FACES: usize = 5;

/// Width and height of face `face` and its first row within the atlas cell of a hemicube `n` pixels wide.
pub(super) fn cell_rectangle(face: usize, n: u32) -> (u32, u32, u32) {
    if face == 0 { (n, n, 0) } else { (n, n / 2, n + (face as u32 - 1) * n / 2) }
}

/// Clip-from-world matrices of the five faces: reversed depth, no far plane.
///
/// The sides show only the half above the horizon, so their projection is off-centre and no pixel is wasted.
pub(super) fn projections(viewpoint: &Viewpoint, near: f32) -> [Mat4; NUM_FACES] {
    let normal = viewpoint.normal;
    let (tangent, bitangent) = tangent_frame(normal);
    let (sin, cos) = (unit_float(hash(viewpoint.seed)) * std::f32::consts::TAU).sin_cos();
    let x = tangent * cos + bitangent * sin;
    let y = bitangent * cos - tangent * sin;
    [
        projection(viewpoint.position, normal, y, false, near),
        projection(viewpoint.position, x, normal, true, near),
        projection(viewpoint.position, y, normal, true, near),
        projection(viewpoint.position, -x, normal, true, near),
        projection(viewpoint.position, -y, normal, true, near),
    ]
}

/// Clip-from-world matrix of a 90 degree face, or of its upper half.
fn projection(eye: Vec3, forward: Vec3, up: Vec3, is_half: bool, near: f32) -> Mat4 {
    let right = forward.cross(up);
    let row = |axis: Vec3| axis.extend(-axis.dot(eye));
    let (to_x, to_y, to_w) = (row(right), row(up), row(forward));
    // y in 0..w becomes -w..w on the half faces.
    let to_y = if is_half { 2.0 * to_y - to_w } else { to_y };
    Mat4::from_cols(to_x, to_y, Vec4::new(0.0, 0.0, 0.0, near), to_w).transpose()
}

/// One face of one hemicube.
pub(super) struct Face {
    pub clip_from_world: Mat4,
    pub eye: Vec3,
    /// Left, top, width and height in the atlas, pixels.
    pub rectangle: [u32; 4],
}

impl Face {
    /// Width and height of the face, pixels.
    pub fn size(&self) -> (u32, u32) {
        (self.rectangle[2], self.rectangle[3])
    }
}

/// The faces of hemicubes that fill an atlas cell by cell.
pub(super) fn faces_of(viewpoints: &[Viewpoint], layout: Layout, near: f32) -> Vec<Face> {
    let of_cell = |(cell, viewpoint): (usize, &Viewpoint)| {
        let (left, top) = layout.origin(cell);
        let eye = viewpoint.position;
        let face = move |(face, clip_from_world)| {
            let (width, height, down) = cell_rectangle(face, layout.n);
            Face { clip_from_world, eye, rectangle: [left, top + down, width, height] }
        };
        projections(viewpoint, near).into_iter().enumerate().map(face)
    };
    viewpoints.iter().enumerate().flat_map(of_cell).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn viewpoint() -> Viewpoint {
        let normal = Vec3::new(0.3, 0.8, -0.2).normalize();
        Viewpoint { position: Vec3::new(1.0, 2.0, 3.0), normal, seed: 5 }
    }

    /// Returns the normalised device coordinates of a point, or `None` if it lies behind the face.
    fn project(matrix: &Mat4, point: Vec3) -> Option<Vec3> {
        let clip = *matrix * point.extend(1.0);
        (clip.w > 0.0).then(|| clip.truncate() / clip.w)
    }

    #[test]
    fn every_direction_above_the_horizon_is_on_one_face() {
        let viewpoint = viewpoint();
        let faces = projections(&viewpoint, 1e-3);
        let (tangent, bitangent) = tangent_frame(viewpoint.normal);
        for i in 0..500 {
            let p = crate::base::sampling::r2(i, 3);
            let (radius, phi) = (p.x.sqrt(), p.y * std::f32::consts::TAU);
            let direction = tangent * (radius * phi.cos())
                + bitangent * (radius * phi.sin())
                + viewpoint.normal * (1.0 - p.x).sqrt();
            let seen = faces
                .iter()
                .filter(|face| {
                    project(face, viewpoint.position + direction)
                        .is_some_and(|ndc| ndc.x.abs() <= 1.0 && ndc.y.abs() <= 1.0)
                })
                .count();
            assert_eq!(seen, 1, "direction {direction}");
        }
    }

    #[test]
    fn depth_is_near_over_distance() {
        let viewpoint = viewpoint();
        let top = projections(&viewpoint, 1e-3)[0];
        let ndc = project(&top, viewpoint.position + viewpoint.normal * 4.0).expect("in front");
        assert!((ndc.z - 1e-3 / 4.0).abs() < 1e-8);
    }
}
