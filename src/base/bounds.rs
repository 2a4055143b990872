//! Axis-aligned boxes, and the test of a box against a view frustum.

use glam::{Mat4, Vec3, Vec4};

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Minimum corner.
    pub low: Vec3,
    /// Maximum corner.
    pub high: Vec3,
}

/// The view frustum of a camera as half spaces, whose normals point inwards.
#[derive(Clone, Copy, Debug)]
pub struct Frustum([Vec4; 5]);

impl Bounds {
    /// The empty box: the neutral element of [`Self::joined`].
    pub const EMPTY: Self = Self { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };

    /// Returns the smallest box that holds all points; [`Self::EMPTY`] if there are none.
    #[must_use]
    pub fn of(points: impl Iterator<Item = Vec3>) -> Self {
        points.fold(Self::EMPTY, |bounds, p| Self { low: bounds.low.min(p), high: bounds.high.max(p) })
    }

    /// Returns the smallest box that holds all points; `None` if there are none.
    #[must_use]
    pub fn around(mut points: impl Iterator<Item = Vec3>) -> Option<Self> {
        let first = points.next()?;
        Some(Self { low: first, high: first }.joined(Self::of(points)))
    }

    /// Returns the smallest box that holds both boxes.
    #[must_use]
    pub fn joined(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Returns the lengths of its edges.
    #[must_use]
    pub fn size(&self) -> Vec3 {
        self.high - self.low
    }

    /// Returns the length of its longest edge.
    #[must_use]
    pub fn extent(&self) -> f32 {
        self.size().max_element()
    }

    /// Returns the distance between opposite corners.
    #[must_use]
    pub fn diagonal(&self) -> f32 {
        self.size().length()
    }

    /// Returns the centre of the box.
    #[must_use]
    pub fn centre(&self) -> Vec3 {
        0.5 * (self.low + self.high)
    }

    /// Returns half of its surface area, as used by the surface area heuristic.
    #[must_use]
    pub fn half_area(&self) -> f32 {
        let size = self.size();
        size.x * size.y + size.y * size.z + size.z * size.x
    }
}

impl Frustum {
    /// Returns the frustum of a clip-from-world matrix, without the far plane.
    ///
    /// Source: Gribb and Hartmann 2001, "Fast Extraction of Viewing Frustum Planes from the World-View-Projection
    /// Matrix".
    #[must_use]
    pub fn new(clip_from_world: &Mat4) -> Self {
        let (x, y, w) = (clip_from_world.row(0), clip_from_world.row(1), clip_from_world.row(3));
        Self([w, w + x, w - x, w + y, w - y])
    }

    /// Returns true if a part of the box may be in view. The test is conservative: it may return true for a box outside
    /// the frustum, near one of its edges.
    #[must_use]
    pub fn meets(&self, bounds: &Bounds) -> bool {
        self.0.iter().all(|plane| {
            let normal = plane.truncate();
            let furthest = Vec3::select(normal.cmpge(Vec3::ZERO), bounds.high, bounds.low);
            normal.dot(furthest) + plane.w >= 0.0
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frustum_meets_boxes_ahead_but_not_behind_or_beside() {
        let view = glam::camera::rh::view::look_to_mat4(Vec3::new(1.0, 2.0, 3.0), Vec3::X, Vec3::Y);
        let frustum =
            Frustum::new(&(glam::camera::rh::proj::directx::perspective_infinite_reverse(1.0, 1.5, 0.1) * view));
        let around = |centre: Vec3| Bounds { low: centre - 0.1, high: centre + 0.1 };
        assert!(frustum.meets(&around(Vec3::new(4.0, 2.0, 3.0))));
        assert!(!frustum.meets(&around(Vec3::new(-2.0, 2.0, 3.0))));
        assert!(!frustum.meets(&around(Vec3::new(2.0, 2.0, 9.0))));
    }
}
