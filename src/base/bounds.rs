//! Boxes, and what of them is in view.

use glam::{Mat4, Vec3, Vec4};

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Smallest corner.
    pub low: Vec3,
    /// Largest corner.
    pub high: Vec3,
}

/// Half spaces whose intersection a face sees; their normals point inwards.
#[derive(Clone, Copy, Debug)]
pub struct Frustum([Vec4; 5]);

impl Bounds {
    /// The box that holds nothing.
    pub const EMPTY: Self = Self { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };

    /// The box round some points; empty where there are none.
    #[must_use]
    pub fn of(points: impl Iterator<Item = Vec3>) -> Self {
        points.fold(Self::EMPTY, |bounds, p| Self { low: bounds.low.min(p), high: bounds.high.max(p) })
    }

    /// The box round both.
    #[must_use]
    pub fn joined(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Half of its surface.
    #[must_use]
    pub fn half_area(&self) -> f32 {
        let size = self.high - self.low;
        size.x * size.y + size.y * size.z + size.z * size.x
    }
}

impl Frustum {
    /// The half spaces of a clip-from-world matrix without far plane.
    #[must_use]
    pub fn new(clip_from_world: &Mat4) -> Self {
        let (x, y, w) = (clip_from_world.row(0), clip_from_world.row(1), clip_from_world.row(3));
        Self([w, w + x, w - x, w + y, w - y])
    }

    /// Something of the box may be seen.
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
    fn a_frustum_meets_what_is_ahead_and_not_what_is_behind_or_beside() {
        let view = glam::camera::rh::view::look_to_mat4(Vec3::new(1.0, 2.0, 3.0), Vec3::X, Vec3::Y);
        let frustum =
            Frustum::new(&(glam::camera::rh::proj::directx::perspective_infinite_reverse(1.0, 1.5, 0.1) * view));
        let around = |centre: Vec3| Bounds { low: centre - 0.1, high: centre + 0.1 };
        assert!(frustum.meets(&around(Vec3::new(4.0, 2.0, 3.0))));
        assert!(!frustum.meets(&around(Vec3::new(-2.0, 2.0, 3.0))));
        assert!(!frustum.meets(&around(Vec3::new(2.0, 2.0, 9.0))));
    }
}
