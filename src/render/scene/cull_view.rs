//! From where a scene is seen, as far as culling depends on it.

use glam::Vec4;

use crate::base::bounds::{Bounds, Frustum};

/// From where a scene is seen, as far as culling depends on it.
#[derive(Clone, Copy, Debug)]
pub struct CullView {
    /// The part of space in view.
    pub frustum: Frustum,
    /// The eye with w = 1, or the direction towards it with w = 0.
    pub eye: Vec4,
    /// Single-sided surfaces are invisible from behind.
    pub cull_back: bool,
}

impl CullView {
    /// A measure of the distance to a box that sorts near before far; `None` if the box is out of view.
    pub(super) fn distance(&self, bounds: &Bounds) -> Option<f32> {
        let Bounds { low, high } = *bounds;
        let eye = self.eye.truncate();
        self.frustum.meets(bounds).then(|| match self.eye.w {
            0.0 => -eye.dot(0.5 * (low + high)),
            _ => eye.distance_squared(eye.clamp(low, high)),
        })
    }
}
