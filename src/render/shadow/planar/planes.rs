//! Planes of triangles.

use glam::{Vec3, Vec4};

use crate::base::ids::TriangleId;
use crate::scene::{Scene, normal_of};

/// Smallest difference between the unit normals of two distinct planes.
pub const SAME_NORMAL: f32 = 1e-4;
/// Smallest distance between two distinct parallel planes, as a share of the scene's extent.
pub const SAME_DISTANCE: f32 = 1e-5;

/// Returns the plane of a triangle as unit normal n and distance w: its points p satisfy n . p + w = 0. Returns
/// `None` if the triangle has no area.
#[must_use]
pub fn plane_of(scene: &Scene, id: TriangleId) -> Option<Vec4> {
    let corners = scene.corners(id);
    let normal = normal_of(corners);
    let distance = -normal.dot((corners[0] + corners[1] + corners[2]) / 3.0);
    (normal != Vec3::ZERO).then(|| normal.extend(distance))
}

/// Returns true if two planes of a scene with this extent (metres) cannot be distinguished by eye.
#[must_use]
pub fn is_same_plane(a: Vec4, b: Vec4, extent: f32) -> bool {
    a.truncate().distance(b.truncate()) < 10.0 * SAME_NORMAL && (a.w - b.w).abs() < 100.0 * SAME_DISTANCE * extent
}
