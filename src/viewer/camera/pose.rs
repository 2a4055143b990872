//! Position, direction and field of view of the viewer's camera.

use glam::{Quat, Vec3};

use crate::base::bounds::Bounds;
use crate::scene::{Camera, Projection};

/// Vertical field of view if the file has no camera, radians.
const DEFAULT_FOV_Y: f32 = 60.0 * std::f32::consts::PI / 180.0;
/// Largest tilt; at 90 degrees the direction to the left would be undefined.
const MAX_PITCH: f32 = 89.0 * std::f32::consts::PI / 180.0;

/// Pose and field of view of a camera that never rolls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraPose {
    /// Position in world space, metres.
    pub position: Vec3,
    /// Rotation about +Y, radians; 0 looks along -Z, positive values turn to the left.
    pub yaw: f32,
    /// Upward tilt, radians.
    pub pitch: f32,
    /// Full vertical field of view, radians.
    pub fov_y: f32,
}

impl CameraPose {
    /// Returns the pose of a camera at `position` that looks along `direction` (of any length).
    #[must_use]
    pub fn looking_along(position: Vec3, direction: Vec3) -> Self {
        let d = direction.normalize_or(Vec3::NEG_Z);
        Self { position, yaw: (-d.x).atan2(-d.z), pitch: d.y.asin().clamp(-MAX_PITCH, MAX_PITCH), fov_y: DEFAULT_FOV_Y }
    }

    /// Returns the pose of a camera of the file without its roll. An orthographic camera gets the default field of
    /// view.
    #[must_use]
    pub fn from_camera(camera: &Camera) -> Self {
        let mut pose = Self::looking_along(camera.position, camera.forward());
        if let Projection::Perspective { fov_y } = camera.projection {
            pose.fov_y = fov_y;
        }
        pose
    }

    /// Returns the unit vector of the viewing direction.
    #[must_use]
    pub fn forward(&self) -> Vec3 {
        self.rotation() * Vec3::NEG_Z
    }

    /// Returns the unit vector of the viewing direction, projected onto the floor.
    #[must_use]
    pub fn heading(&self) -> Vec3 {
        Quat::from_rotation_y(self.yaw) * Vec3::NEG_Z
    }

    /// Returns the unit vector to the right, which is always horizontal.
    #[must_use]
    pub fn right(&self) -> Vec3 {
        Quat::from_rotation_y(self.yaw) * Vec3::X
    }

    /// Turns by `left` about +Y and tilts by `up`, radians. The tilt is limited to just below 90 degrees.
    pub fn turn(&mut self, left: f32, up: f32) {
        self.yaw = (self.yaw + left).rem_euclid(std::f32::consts::TAU);
        self.pitch = (self.pitch + up).clamp(-MAX_PITCH, MAX_PITCH);
    }

    /// Returns the unit vector from the camera through a point of the picture, given as -1..1 to the right and up.
    #[must_use]
    pub fn direction(&self, at: [f32; 2], aspect: f32) -> Vec3 {
        let half = (0.5 * self.fov_y).tan();
        (self.rotation() * Vec3::new(at[0] * half * aspect, at[1] * half, -1.0)).normalize()
    }

    /// Projects a point into the picture: -1..1 to the right and up; `None` if it lies behind the camera.
    #[must_use]
    pub fn project(&self, point: Vec3, aspect: f32) -> Option<[f32; 2]> {
        let seen = self.rotation().inverse() * (point - self.position);
        let half = -seen.z * (0.5 * self.fov_y).tan();
        (half > 0.0).then(|| [seen.x / (half * aspect), seen.y / half])
    }

    /// Turns as [`CameraPose::turn`] does, but about `pivot`, whose position in the picture does not change.
    pub fn orbit(&mut self, pivot: Vec3, left: f32, up: f32) {
        let arm = self.rotation().inverse() * (self.position - pivot);
        self.turn(left, up);
        self.position = pivot + self.rotation() * arm;
    }

    /// Moves back along the viewing direction until the whole box is in view.
    pub fn frame(&mut self, bounds: Bounds, aspect: f32) {
        let radius = (0.5 * bounds.diagonal()).max(1e-3);
        let half_angle = 0.5 * self.fov_y.min(2.0 * ((0.5 * self.fov_y).tan() * aspect).atan());
        self.position = bounds.centre() - self.forward() * (radius / half_angle.sin());
    }

    /// Returns the camera that pictures are rendered with.
    #[must_use]
    pub fn camera(&self) -> Camera {
        Camera {
            name: "eye".to_owned(),
            position: self.position,
            world_from_view: self.rotation(),
            projection: Projection::Perspective { fov_y: self.fov_y },
        }
    }

    /// Formats the pose as an option of `hemicube render`.
    #[must_use]
    pub fn render_option(&self) -> String {
        let (p, f) = (self.position, self.forward());
        let numbers = [p.x, p.y, p.z, f.x, f.y, f.z].map(|number| format!("{number:.4}")).join(",");
        format!("--eye={numbers},{:.2}", self.fov_y.to_degrees())
    }

    fn rotation(&self) -> Quat {
        Quat::from_rotation_y(self.yaw) * Quat::from_rotation_x(self.pitch)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::View;

    #[test]
    fn looking_along_and_forward_are_inverse() {
        for direction in [Vec3::NEG_Z, Vec3::X, Vec3::new(1.0, 2.0, 3.0), Vec3::new(-4.0, -1.0, 0.5)] {
            let pose = CameraPose::looking_along(Vec3::ZERO, direction);
            assert!((pose.forward() - direction.normalize()).length() < 1e-5, "{direction} {}", pose.forward());
        }
    }

    #[test]
    fn the_view_matrix_agrees_with_look_at() {
        let pose = CameraPose::looking_along(Vec3::new(1.0, 2.0, 3.0), Vec3::new(0.3, -0.2, 0.9));
        let expected = glam::camera::rh::view::look_to_mat4(pose.position, pose.forward(), Vec3::Y);
        assert!(pose.camera().view_from_world().abs_diff_eq(expected, 1e-5));
    }

    #[test]
    fn the_pose_of_a_file_camera_is_exact() {
        let camera = Camera::looking_at("c", Vec3::new(3.0, 1.0, 2.0), Vec3::new(0.0, 1.5, -1.0), 0.7);
        let pose = CameraPose::from_camera(&camera);
        assert!((pose.forward() - camera.forward()).length() < 1e-5);
        assert_eq!((pose.position, pose.fov_y), (camera.position, 0.7));
    }

    #[test]
    fn turning_left_looks_left_and_pitch_stops_before_the_poles() {
        let mut pose = CameraPose::looking_along(Vec3::ZERO, Vec3::NEG_Z);
        pose.turn(std::f32::consts::FRAC_PI_2, 0.0);
        assert!((pose.forward() - Vec3::NEG_X).length() < 1e-5);
        pose.turn(0.0, 10.0);
        assert!(pose.forward().y < 1.0 && pose.forward().y > 0.999);
        assert!(pose.right().y.abs() < 1e-6);
    }

    #[test]
    fn the_direction_through_a_pixel_projects_back_to_it() {
        let pose = CameraPose::looking_along(Vec3::new(1.0, 2.0, 3.0), Vec3::new(0.3, -0.4, 0.8));
        for at in [[0.0, 0.0], [0.7, -0.9], [-1.0, 1.0]] {
            let place = pose.project(pose.position + 4.0 * pose.direction(at, 1.6), 1.6).expect("before the eye");
            assert!((place[0] - at[0]).abs() < 1e-4 && (place[1] - at[1]).abs() < 1e-4, "{at:?} {place:?}");
        }
        assert_eq!(pose.project(pose.position - pose.forward(), 1.6), None);
    }

    #[test]
    fn orbiting_keeps_the_distance_and_the_picture_of_the_pivot() {
        let mut pose = CameraPose::looking_along(Vec3::new(0.0, 1.5, 4.0), Vec3::new(0.2, -0.1, -1.0));
        let pivot = Vec3::new(0.5, 0.8, -1.0);
        let (distance, place) = (pose.position.distance(pivot), pose.project(pivot, 1.5).expect("seen"));
        pose.orbit(pivot, 1.1, -0.4);
        let after = pose.project(pivot, 1.5).expect("still seen");
        assert!((pose.position.distance(pivot) - distance).abs() < 1e-4);
        assert!((place[0] - after[0]).abs() < 1e-4 && (place[1] - after[1]).abs() < 1e-4, "{place:?} {after:?}");
    }

    #[test]
    fn the_framed_box_is_inside_the_picture() {
        let bounds = Bounds { low: Vec3::new(-3.0, 0.0, -2.0), high: Vec3::new(5.0, 4.0, 9.0) };
        for aspect in [0.5, 1.0, 2.0] {
            let mut pose = CameraPose::looking_along(Vec3::ZERO, Vec3::new(1.0, -0.5, 0.3));
            pose.frame(bounds, aspect);
            let projection_from_world = View::from_camera(&pose.camera(), aspect).projection_from_world();
            for corner in 0..8 {
                let pick =
                    |bit: u32, axis: usize| if corner >> bit & 1 == 0 { bounds.low[axis] } else { bounds.high[axis] };
                let point = Vec3::new(pick(0, 0), pick(1, 1), pick(2, 2));
                let clip = projection_from_world * point.extend(1.0);
                assert!(clip.w > 0.0 && clip.x.abs() <= clip.w && clip.y.abs() <= clip.w, "{aspect} {point} {clip}");
            }
        }
    }

    #[test]
    fn the_option_states_position_direction_and_angle() {
        let pose = CameraPose::looking_along(Vec3::new(1.0, 1.65, -2.0), Vec3::NEG_Z);
        assert_eq!(pose.render_option(), "--eye=1.0000,1.6500,-2.0000,0.0000,0.0000,-1.0000,60.00");
    }
}
