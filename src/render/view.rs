//! The camera of a picture as matrices, with reversed depth.
//!
//! The depth of a point at distance d is near / d: 1 at the near plane and 0 at infinity (Lapidous and Jiao 1999,
//! "Optimal Depth Buffer for Low-Cost Graphics Hardware"). In a float buffer its relative precision is nearly the same
//! at every distance, so the near plane can be a millimetre away and no far plane is needed.

use glam::camera::rh::proj::directx;
use glam::{Mat4, Vec3, Vec4};

use crate::base::bounds::Frustum;
use crate::render::scene::cull_view::CullView;
use crate::scene::{Camera, Projection};

/// Distance of the near plane of a perspective view, metres.
const NEAR: f32 = 1e-3;
/// Depth of an orthographic view, metres.
const ORTHOGRAPHIC_DEPTH: f32 = 1e3;

/// The camera of a picture.
///
/// Passes clear the reversed depth to 0 and compare with Greater; a point at infinity (w = 0) is never clipped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Eye point, metres.
    pub camera_position: Vec3,
    /// Matrix from world space to view space.
    pub view_from_world: Mat4,
    /// Matrix from view space to clip space.
    pub projection_from_view: Mat4,
}

impl View {
    /// Returns the view of `camera` for a picture whose width is `aspect` times its height.
    #[must_use]
    pub fn from_camera(camera: &Camera, aspect: f32) -> Self {
        let projection_from_view = match camera.projection {
            Projection::Perspective { fov_y } => directx::perspective_infinite_reverse(fov_y, aspect, NEAR),
            Projection::Orthographic { half_height } => {
                let half_width = half_height * aspect;
                // Far and near are exchanged, which reverses the depth.
                directx::orthographic(-half_width, half_width, -half_height, half_height, ORTHOGRAPHIC_DEPTH, 0.0)
            }
        };
        Self { camera_position: camera.position, view_from_world: camera.view_from_world(), projection_from_view }
    }

    /// Returns the part of space in view.
    #[must_use]
    pub fn frustum(&self) -> Frustum {
        Frustum::new(&self.projection_from_world())
    }

    /// Returns the view for culling; `cull_back` is [`RenderSettings::cull_back`](super::RenderSettings::cull_back).
    #[must_use]
    pub fn cull_view(&self, cull_back: bool) -> CullView {
        CullView { frustum: self.frustum(), eye: self.eye(), cull_back }
    }

    /// Returns the matrix from world space to clip space.
    #[must_use]
    pub fn projection_from_world(&self) -> Mat4 {
        self.projection_from_view * self.view_from_world
    }

    /// Returns the depth of a point at `distance` metres along the axis of the view.
    #[must_use]
    pub fn depth_at(&self, distance: f32) -> f32 {
        self.projection_from_view.project_point3(Vec3::new(0.0, 0.0, -distance)).z
    }

    /// Returns the homogeneous eye: its position with w = 1, or in an orthographic view the unit vector towards the eye
    /// with w = 0.
    #[must_use]
    pub fn eye(&self) -> Vec4 {
        let is_perspective = self.projection_from_view.w_axis.w == 0.0;
        if is_perspective {
            self.camera_position.extend(1.0)
        } else {
            self.view_from_world.row(2).truncate().extend(0.0)
        }
    }

    /// Returns the vector from a point to the eye, metres; in an orthographic view the unit vector towards it.
    #[must_use]
    pub fn towards_eye(&self, point: Vec3) -> Vec3 {
        self.eye().truncate() - self.eye().w * point
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn depth(view: &View, point: Vec3) -> f32 {
        view.projection_from_world().project_point3(point).z
    }

    #[test]
    fn depth_falls_from_one_at_the_near_plane_to_zero() {
        let camera = Camera::looking_at("test", Vec3::new(1.0, 2.0, 3.0), Vec3::new(1.0, 2.0, 0.0), 1.0);
        let view = View::from_camera(&camera, 1.5);
        let at = |distance| depth(&view, Vec3::new(1.0, 2.0, 3.0 - distance));
        assert!((at(NEAR) - 1.0).abs() < 1e-3, "{}", at(NEAR));
        assert!(at(1.0) > at(2.0) && at(2.0) > at(1e6) && at(1e6) > 0.0);
    }

    #[test]
    fn orthographic_depth_is_reversed_too_and_the_height_is_that_of_the_camera() {
        let mut camera = Camera::looking_at("test", Vec3::ZERO, Vec3::NEG_Z, 1.0);
        camera.projection = Projection::Orthographic { half_height: 2.0 };
        let view = View::from_camera(&camera, 1.0);
        assert!((depth(&view, Vec3::ZERO) - 1.0).abs() < 1e-6);
        assert!(depth(&view, Vec3::NEG_Z) > depth(&view, 2.0 * Vec3::NEG_Z));
        assert!((view.towards_eye(Vec3::X) - Vec3::Z).length() < 1e-6);
        let top = view.projection_from_world().project_point3(Vec3::new(0.0, 2.0, -5.0));
        assert!((top.y - 1.0).abs() < 1e-6, "{top}");
    }
}
