//! The view of a scene, as far as culling depends on it.

use glam::Vec4;

use crate::base::bounds::{Bounds, Frustum};

/// The view of a scene, as far as culling depends on it.
#[derive(Clone, Copy, Debug)]
pub struct CullView {
    /// The part of space in view.
    pub frustum: Frustum,
    /// The eye with w = 1, or the direction towards it with w = 0.
    pub eye: Vec4,
    /// True if single-sided surfaces are invisible from behind.
    pub cull_back: bool,
}

impl CullView {
    /// Returns a value that increases with the distance to a box, to sort by; `None` if the box is out of view.
    pub(super) fn distance(&self, bounds: &Bounds) -> Option<f32> {
        let Bounds { low, high } = *bounds;
        let eye = self.eye.truncate();
        self.frustum.meets(bounds).then(|| match self.eye.w {
            0.0 => -eye.dot(0.5 * (low + high)),
            _ => eye.distance_squared(eye.clamp(low, high)),
        })
    }
}
