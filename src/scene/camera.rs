//! Cameras of the file.

use glam::{Mat4, Quat, Vec3};

use crate::base::bounds::Bounds;

/// A camera placed in the world; it looks along its own -Z with +Y up (glTF).
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Name of its node or of the camera, else `camera N`.
    pub name: String,
    /// Eye point, metres.
    pub position: Vec3,
    /// Rotation from view space to world space.
    pub world_from_view: Quat,
    /// Its projection.
    pub projection: Projection,
}

/// Projection of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Perspective projection.
    Perspective {
        /// Vertical field of view (the full angle), radians.
        fov_y: f32,
    },
    /// Parallel projection.
    Orthographic {
        /// Half the height of the view, metres.
        half_height: f32,
    },
}

impl Camera {
    /// Returns a perspective camera at `position` that looks at `target`, +Y up.
    #[must_use]
    pub fn looking_at(name: &str, position: Vec3, target: Vec3, fov_y: f32) -> Self {
        let view_from_world = glam::camera::rh::view::look_at_mat4(position, target, Vec3::Y);
        Self {
            name: name.to_owned(),
            position,
            world_from_view: Quat::from_mat4(&view_from_world).inverse().normalize(),
            projection: Projection::Perspective { fov_y },
        }
    }

    /// Returns a camera above one corner of the box that sees all of it; the default for scenes without a camera.
    #[must_use]
    pub fn framing(bounds: Bounds) -> Self {
        let fov_y = 45f32.to_radians();
        let centre = bounds.centre();
        let radius = (0.5 * bounds.diagonal()).max(1e-3);
        // At this distance the bounding sphere touches the edges of the view.
        let distance = radius / (0.5 * fov_y).sin();
        let direction = Vec3::new(0.5, 0.4, 1.0).normalize();
        Self::looking_at("overview", centre + distance * direction, centre, fov_y)
    }

    /// Returns the matrix from world space to view space.
    #[must_use]
    pub fn view_from_world(&self) -> Mat4 {
        Mat4::from_rotation_translation(self.world_from_view, self.position).inverse()
    }

    /// Returns the unit vector in which the camera looks, in world space.
    #[must_use]
    pub fn forward(&self) -> Vec3 {
        self.world_from_view * Vec3::NEG_Z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn framing_sees_every_corner_of_the_box() {
        let (low, high) = (Vec3::new(-3.0, 0.0, 2.0), Vec3::new(5.0, 2.5, 30.0));
        let camera = Camera::framing(Bounds { low, high });
        let projection = glam::camera::rh::proj::directx::perspective_infinite_reverse(45f32.to_radians(), 1.0, 0.01);
        for i in 0..8u32 {
            let corner = Vec3::select(glam::BVec3::new(i & 1 > 0, i & 2 > 0, i & 4 > 0), high, low);
            let seen = (projection * camera.view_from_world()).project_point3(corner);
            assert!(seen.truncate().abs().max_element() <= 1.0 && seen.z > 0.0, "{corner} is at {seen}");
        }
    }

    #[test]
    fn framing_a_single_point_gives_a_finite_camera() {
        let camera = Camera::framing(Bounds { low: Vec3::ONE, high: Vec3::ONE });
        assert!(camera.position.is_finite() && camera.position != Vec3::ONE);
    }
}
