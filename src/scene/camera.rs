//! Cameras of the file.

use glam::{Mat4, Quat, Vec3};

/// A camera placed in the world; it looks along its own -Z with +Y up (glTF).
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Name of its node or of the camera, else `camera N`.
    pub name: String,
    /// Eye point, metres.
    pub position: Vec3,
    /// Rotation from view space to world space.
    pub world_from_view: Quat,
    /// How it projects.
    pub projection: Projection,
}

/// Projection of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Vertical field of view in radians.
    Perspective {
        /// Full vertical angle, radians.
        fov_y: f32,
    },
    /// Half the height of the view in metres.
    Orthographic {
        /// Half height, metres.
        half_height: f32,
    },
}

impl Camera {
    /// A perspective camera at `position` that looks at `target`, +Y up.
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

    /// Matrix from world space to view space.
    #[must_use]
    pub fn view_from_world(&self) -> Mat4 {
        Mat4::from_rotation_translation(self.world_from_view, self.position).inverse()
    }

    /// Unit vector in which the camera looks, in world space.
    #[must_use]
    pub fn forward(&self) -> Vec3 {
        self.world_from_view * Vec3::NEG_Z
    }
}
