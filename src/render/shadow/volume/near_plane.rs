//! Tests which shadow volumes reach the near plane.

use glam::{Vec3, Vec4};

use crate::render::View;

/// Margin for rounding, as a share of the distance from the near plane to the triangle or to the light, whichever is
/// larger. A light farther away than 1 km counts as 1 km away.
const MARGIN: f32 = 1e-5;
/// Substitute for the distance of a directional light, metres.
const FAR_AWAY: f32 = 1e6;

/// A disc round the visible part of the near plane.
pub struct NearPlane {
    centre: Vec3,
    radius: f32,
}

impl NearPlane {
    /// Returns the disc round the near plane of a view.
    #[must_use]
    pub fn new(view: &View) -> Self {
        let world_from_projection = view.projection_from_world().inverse();
        let at = |x, y| world_from_projection.project_point3(Vec3::new(x, y, 1.0));
        let centre = at(0.0, 0.0);
        Self { centre, radius: centre.distance(at(1.0, 1.0)) }
    }

    /// Returns true if the shadow volume of a triangle may reach the near plane. `light` is the homogeneous position of
    /// the light. The test is conservative: it may return true for a volume that does not reach the plane.
    ///
    /// The volume reaches the plane if the triangle intersects the cone from the light to the near plane. A capsule
    /// round the cone's axis bounds the cone.
    #[must_use]
    pub fn is_reached_by_volume(&self, corners: [Vec3; 3], light: Vec4) -> bool {
        let to_light = if light.w == 0.0 { light.truncate() * FAR_AWAY } else { light.truncate() - self.centre };
        let radius = 2.0 * self.radius + MARGIN * corners[0].distance(self.centre).max(to_light.length().min(1e3));
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        let extent = corners.iter().map(|corner| corner.distance(middle)).fold(0.0, f32::max);
        let along =
            ((middle - self.centre).dot(to_light) / to_light.length_squared().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
        if (self.centre + along * to_light).distance(middle) > radius + extent {
            return false;
        }
        // The triangle misses the cone if both ends of the axis are on one side of its plane, and far from it.
        let normal = crate::scene::normal_of(corners);
        let from = normal.dot(self.centre - corners[0]);
        let to = normal.dot(self.centre + to_light - corners[0]);
        !(from.min(to) > radius || from.max(to) < -radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Camera;

    fn looking_along_x() -> NearPlane {
        NearPlane::new(&View::from_camera(&Camera::looking_at("", Vec3::ZERO, Vec3::X, 1.0), 1.5))
    }

    /// A triangle of size one across the Y axis at height `y`, shifted by `x`.
    fn above(x: f32, y: f32) -> [Vec3; 3] {
        [Vec3::new(x - 1.0, y, -1.0), Vec3::new(x + 1.0, y, -1.0), Vec3::new(x, y, 1.0)]
    }

    #[test]
    fn a_triangle_between_eye_and_light_reaches_the_near_plane() {
        let reaches = |corners, light| looking_along_x().is_reached_by_volume(corners, light);
        for light in [Vec4::new(0.0, 5.0, 0.0, 1.0), Vec4::new(0.0, 1.0, 0.0, 0.0)] {
            assert!(reaches(above(0.0, 2.0), light));
            assert!(!reaches(above(9.0, 2.0), light));
            assert!(!reaches(above(0.0, -2.0), light));
        }
        assert!(!reaches(above(0.0, 7.0), Vec4::new(0.0, 5.0, 0.0, 1.0)), "beyond the light");
    }
}
