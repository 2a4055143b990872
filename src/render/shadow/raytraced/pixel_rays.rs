//! Lines of sight through the pixels of a picture.

use glam::{DMat4, DVec2, DVec3, DVec4};

use crate::render::View;
use crate::render::shadow::shared::exact_rays::Line;

/// Depth of the second of the two points that define the line through a pixel. The first is on the near plane.
const SECOND_DEPTH: f64 = 0.5;

/// Lines through the pixels of a picture, in double precision.
pub struct PixelRays {
    world_from_projection: DMat4,
    /// Homogeneous position.
    eye: DVec4,
    size: [u32; 2],
}

impl PixelRays {
    /// Returns the lines of a view for a picture of `size` pixels.
    pub fn new(view: &View, size: [u32; 2]) -> Self {
        let world_from_projection = view.projection_from_world().as_dmat4().inverse();
        Self { world_from_projection, eye: view.eye().as_dvec4(), size }
    }

    /// Returns the line that begins on the near plane and leads away from the eye, `offset` pixels beside the middle of
    /// a pixel.
    pub fn through(&self, pixel: usize, offset: DVec2) -> Line {
        let [width, height] = self.size.map(f64::from);
        let (column, row) = ((pixel % self.size[0] as usize) as f64, (pixel / self.size[0] as usize) as f64);
        let (x, y) = (2.0 * (column + 0.5 + offset.x) / width - 1.0, 1.0 - 2.0 * (row + 0.5 + offset.y) / height);
        let at = |depth| self.world_from_projection.project_point3(DVec3::new(x, y, depth));
        let origin = at(1.0);
        Line { origin, direction: (at(SECOND_DEPTH) - origin).normalize(), reach: f64::INFINITY }
    }

    /// Returns the vector from a point to the eye, metres; a unit vector if the eye is infinitely far.
    pub fn towards_eye(&self, point: DVec3) -> DVec3 {
        self.eye.truncate() - self.eye.w * point
    }
}
