//! The eye of the viewer: where it stands, where it looks, and how smoothly it gets going.
//!
//! Pure: no window, no clock, no scene. What the keys mean is in [`super::input`], walls and floors are in
//! [`super::walk`].

use glam::{Quat, Vec3};

use crate::base::bounds::Bounds;
use crate::scene::{Camera, Projection};

/// Vertical field of view of a file that brings no camera, radians.
const DEFAULT_FOV_Y: f32 = 60.0 * std::f32::consts::PI / 180.0;
/// Looking straight up or down is stopped just short of it, so that "left" stays defined.
const MAX_PITCH: f32 = 89.0 * std::f32::consts::PI / 180.0;
/// Time in which a movement takes up 63 % of its wanted speed, seconds.
const GLIDE_TIME: f32 = 0.07;

/// An eye that never rolls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    /// Metres, in world space.
    pub position: Vec3,
    /// Turn about +Y, radians; 0 looks along -Z, positive to the left.
    pub yaw: f32,
    /// Upward tilt, radians.
    pub pitch: f32,
    /// Full vertical field of view, radians.
    pub fov_y: f32,
}

impl Eye {
    /// An eye at `position` that looks along `direction` (any length).
    #[must_use]
    pub fn looking_along(position: Vec3, direction: Vec3) -> Self {
        let d = direction.normalize_or(Vec3::NEG_Z);
        Self { position, yaw: (-d.x).atan2(-d.z), pitch: d.y.asin().clamp(-MAX_PITCH, MAX_PITCH), fov_y: DEFAULT_FOV_Y }
    }

    /// Where a camera of the file stands; its roll is dropped, and an orthographic one gets the default field of view.
    #[must_use]
    pub fn from_camera(camera: &Camera) -> Self {
        let mut eye = Self::looking_along(camera.position, camera.forward());
        if let Projection::Perspective { fov_y } = camera.projection {
            eye.fov_y = fov_y;
        }
        eye
    }

    /// Unit vector in which the eye looks.
    #[must_use]
    pub fn forward(&self) -> Vec3 {
        self.rotation() * Vec3::NEG_Z
    }

    /// Unit vector forward along the floor.
    #[must_use]
    pub fn heading(&self) -> Vec3 {
        Quat::from_rotation_y(self.yaw) * Vec3::NEG_Z
    }

    /// Unit vector to the right, always level.
    #[must_use]
    pub fn right(&self) -> Vec3 {
        Quat::from_rotation_y(self.yaw) * Vec3::X
    }

    /// Turns by angles in radians: `left` about +Y, `up` with a stop at the poles.
    pub fn turn(&mut self, left: f32, up: f32) {
        self.yaw = (self.yaw + left).rem_euclid(std::f32::consts::TAU);
        self.pitch = (self.pitch + up).clamp(-MAX_PITCH, MAX_PITCH);
    }

    /// Unit vector through a point of the picture, given as -1..1 to the right and up.
    #[must_use]
    pub fn direction(&self, at: [f32; 2], aspect: f32) -> Vec3 {
        let half = (0.5 * self.fov_y).tan();
        (self.rotation() * Vec3::new(at[0] * half * aspect, at[1] * half, -1.0)).normalize()
    }

    /// Where a point is seen in the picture, -1..1 to the right and up; none behind the eye.
    #[must_use]
    pub fn place_of(&self, point: Vec3, aspect: f32) -> Option<[f32; 2]> {
        let seen = self.rotation().inverse() * (point - self.position);
        let half = -seen.z * (0.5 * self.fov_y).tan();
        (half > 0.0).then(|| [seen.x / (half * aspect), seen.y / half])
    }

    /// Turns about `pivot` as [`Eye::turn`] turns about the eye: the pivot stays where it is in the picture.
    pub fn orbit(&mut self, pivot: Vec3, left: f32, up: f32) {
        let arm = self.rotation().inverse() * (self.position - pivot);
        self.turn(left, up);
        self.position = pivot + self.rotation() * arm;
    }

    /// Moves back along the line of sight until the whole box is in view.
    pub fn frame(&mut self, bounds: Bounds, aspect: f32) {
        let radius = (0.5 * bounds.diagonal()).max(1e-3);
        let half_angle = 0.5 * self.fov_y.min(2.0 * ((0.5 * self.fov_y).tan() * aspect).atan());
        self.position = bounds.centre() - self.forward() * (radius / half_angle.sin());
    }

    /// The eye as a camera that pictures are taken with.
    #[must_use]
    pub fn camera(&self) -> Camera {
        Camera {
            name: "eye".to_owned(),
            position: self.position,
            world_from_view: self.rotation(),
            projection: Projection::Perspective { fov_y: self.fov_y },
        }
    }

    fn rotation(&self) -> Quat {
        Quat::from_rotation_y(self.yaw) * Quat::from_rotation_x(self.pitch)
    }
}

/// Speed that follows the wanted speed smoothly.
///
/// Equation: dv/dt = (wanted - v) / T, solved exactly, so the path is the same at every frame rate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Glide {
    velocity: Vec3,
}

impl Glide {
    /// Displacement over `seconds` while `wanted` (metres a second) stays the same.
    pub fn advance(&mut self, wanted: Vec3, seconds: f32) -> Vec3 {
        let kept = (-seconds / GLIDE_TIME).exp();
        let gap = self.velocity - wanted;
        self.velocity = wanted + gap * kept;
        if wanted == Vec3::ZERO && self.velocity.length_squared() < 1e-3 * gap.length_squared().max(1e-3) {
            self.velocity = Vec3::ZERO;
        }
        wanted * seconds + gap * (GLIDE_TIME * (1.0 - kept))
    }

    /// Still moving.
    #[must_use]
    pub fn is_moving(&self) -> bool {
        self.velocity != Vec3::ZERO
    }

    /// Stands still at once (a jump to a camera).
    pub fn stop(&mut self) {
        self.velocity = Vec3::ZERO;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::View;

    #[test]
    fn looking_along_and_forward_are_inverse() {
        for direction in [Vec3::NEG_Z, Vec3::X, Vec3::new(1.0, 2.0, 3.0), Vec3::new(-4.0, -1.0, 0.5)] {
            let eye = Eye::looking_along(Vec3::ZERO, direction);
            assert!((eye.forward() - direction.normalize()).length() < 1e-5, "{direction} {}", eye.forward());
        }
    }

    #[test]
    fn the_view_matrix_agrees_with_look_at() {
        let eye = Eye::looking_along(Vec3::new(1.0, 2.0, 3.0), Vec3::new(0.3, -0.2, 0.9));
        let expected = glam::camera::rh::view::look_to_mat4(eye.position, eye.forward(), Vec3::Y);
        assert!(eye.camera().view_from_world().abs_diff_eq(expected, 1e-5));
    }

    #[test]
    fn a_file_camera_is_met_exactly() {
        let camera = Camera::looking_at("c", Vec3::new(3.0, 1.0, 2.0), Vec3::new(0.0, 1.5, -1.0), 0.7);
        let eye = Eye::from_camera(&camera);
        assert!((eye.forward() - camera.forward()).length() < 1e-5);
        assert_eq!((eye.position, eye.fov_y), (camera.position, 0.7));
    }

    #[test]
    fn turning_left_looks_left_and_pitch_stops_before_the_poles() {
        let mut eye = Eye::looking_along(Vec3::ZERO, Vec3::NEG_Z);
        eye.turn(std::f32::consts::FRAC_PI_2, 0.0);
        assert!((eye.forward() - Vec3::NEG_X).length() < 1e-5);
        eye.turn(0.0, 10.0);
        assert!(eye.forward().y < 1.0 && eye.forward().y > 0.999);
        assert!(eye.right().y.abs() < 1e-6);
    }

    #[test]
    fn a_direction_leads_back_to_its_place_in_the_picture() {
        let eye = Eye::looking_along(Vec3::new(1.0, 2.0, 3.0), Vec3::new(0.3, -0.4, 0.8));
        for at in [[0.0, 0.0], [0.7, -0.9], [-1.0, 1.0]] {
            let place = eye.place_of(eye.position + 4.0 * eye.direction(at, 1.6), 1.6).expect("before the eye");
            assert!((place[0] - at[0]).abs() < 1e-4 && (place[1] - at[1]).abs() < 1e-4, "{at:?} {place:?}");
        }
        assert_eq!(eye.place_of(eye.position - eye.forward(), 1.6), None);
    }

    #[test]
    fn orbiting_keeps_the_distance_and_the_pivot_in_its_place() {
        let mut eye = Eye::looking_along(Vec3::new(0.0, 1.5, 4.0), Vec3::new(0.2, -0.1, -1.0));
        let pivot = Vec3::new(0.5, 0.8, -1.0);
        let (distance, place) = (eye.position.distance(pivot), eye.place_of(pivot, 1.5).expect("seen"));
        eye.orbit(pivot, 1.1, -0.4);
        let after = eye.place_of(pivot, 1.5).expect("still seen");
        assert!((eye.position.distance(pivot) - distance).abs() < 1e-4);
        assert!((place[0] - after[0]).abs() < 1e-4 && (place[1] - after[1]).abs() < 1e-4, "{place:?} {after:?}");
    }

    #[test]
    fn the_framed_box_is_inside_the_picture() {
        let bounds = Bounds { low: Vec3::new(-3.0, 0.0, -2.0), high: Vec3::new(5.0, 4.0, 9.0) };
        for aspect in [0.5, 1.0, 2.0] {
            let mut eye = Eye::looking_along(Vec3::ZERO, Vec3::new(1.0, -0.5, 0.3));
            eye.frame(bounds, aspect);
            let projection_from_world = View::from_camera(&eye.camera(), aspect).projection_from_world();
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
    fn gliding_is_the_same_at_every_frame_rate() {
        let run = |frames: u32| {
            let mut glide = Glide::default();
            let step = 0.5 / frames as f32;
            (0..frames).map(|_| glide.advance(Vec3::new(3.0, 0.0, -1.0), step)).sum::<Vec3>()
        };
        assert!((run(1) - run(50)).length() < 1e-4, "{} {}", run(1), run(50));
    }

    #[test]
    fn gliding_comes_to_rest() {
        let mut glide = Glide::default();
        glide.advance(Vec3::X, 1.0);
        for _ in 0..60 {
            glide.advance(Vec3::ZERO, 1.0 / 60.0);
        }
        assert!(!glide.is_moving());
    }
}
