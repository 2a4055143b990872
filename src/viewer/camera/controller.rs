//! Moves the camera: flying or walking, at a speed that fits the size of the scene.

use glam::Vec3;

use crate::base::bounds::Bounds;
use crate::viewer::camera::collider::Collider;
use crate::viewer::camera::glide::Glide;
use crate::viewer::camera::pose::CameraPose;
use crate::viewer::camera::walk::{Body, Walker};

/// Walking speed, m/s.
const PACE: f32 = 2.0;
/// Flying speed / walking speed.
const FLYING: f32 = 1.5;
/// Running speed / walking speed.
const RUNNING: f32 = 2.5;
/// Turn and tilt by the arrow keys, radians per second.
const TURN_RATE: f32 = 1.4;
/// Factor on the speed for one notch of the wheel.
const NOTCH: f32 = 1.15;
/// Range of the factor that the wheel sets.
const SPEED_RANGE: (f32, f32) = (0.05, 50.0);
/// Largest time step of a frame, seconds.
const MAX_FRAME: f32 = 0.25;

/// Movement that keys request; each axis is -1..1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotionInput {
    /// Along the viewing direction; along the floor when walking.
    pub forward: f32,
    /// To the right.
    pub right: f32,
    /// Upwards; without effect when walking.
    pub up: f32,
    /// Turn to the left.
    pub turn_left: f32,
    /// Tilt upwards.
    pub turn_up: f32,
    /// Run.
    pub run: bool,
}

impl MotionInput {
    /// Returns true if an axis is not zero; `run` alone is no movement.
    #[must_use]
    pub fn is_moving(&self) -> bool {
        [self.forward, self.right, self.up, self.turn_left, self.turn_up].iter().any(|&axis| axis != 0.0)
    }
}

/// The pose of the camera and the state of its movement.
pub struct CameraController {
    /// Position and direction of the camera.
    pub pose: CameraPose,
    /// `None` while the camera flies.
    walker: Option<Walker>,
    glide: Glide,
    /// Size of a person in this scene / size of a real person.
    scale: f32,
    /// Factor on the speed that the wheel sets.
    speed_factor: f32,
}

impl CameraController {
    /// Creates a controller. The camera walks if `pose` is at about eye height above a floor, and flies otherwise.
    #[must_use]
    pub fn new(pose: CameraPose, collider: &Collider) -> Self {
        let scale = scale_of(collider.bounds());
        let mut controller = Self { pose, walker: None, glide: Glide::default(), scale, speed_factor: 1.0 };
        let eye_height = Body::of_scale(scale).eye_height;
        let floor = collider.below(pose.position, 1.35 * eye_height);
        if floor.is_some_and(|floor| pose.position.y - floor.height > 0.6 * eye_height) {
            controller.walk(collider);
        }
        controller
    }

    /// Returns true if the camera walks.
    #[must_use]
    pub fn is_walking(&self) -> bool {
        self.walker.is_some()
    }

    /// Switches between walking and flying.
    ///
    /// # Errors
    /// Returns an error if there is no floor below to walk on; the camera then flies.
    pub fn toggle_walking(&mut self, collider: &Collider) -> Result<(), NoFloor> {
        if self.walker.take().is_none() {
            self.walk(collider);
            return if self.is_walking() { Ok(()) } else { Err(NoFloor) };
        }
        Ok(())
    }

    /// Sets the pose; the camera then walks or flies as [`CameraController::new`] decides.
    pub fn jump(&mut self, pose: CameraPose, collider: &Collider) {
        let speed_factor = self.speed_factor;
        *self = Self { speed_factor, ..Self::new(pose, collider) };
    }

    /// Flies back until the whole scene is in view.
    pub fn frame_all(&mut self, collider: &Collider, aspect: f32) {
        self.frame(collider.bounds(), aspect);
    }

    /// Flies round a point.
    pub fn orbit(&mut self, pivot: Vec3, left: f32, up: f32) {
        self.walker = None;
        self.glide.stop();
        self.pose.orbit(pivot, left, up);
    }

    /// Flies back until a box is in view.
    pub fn frame(&mut self, bounds: Bounds, aspect: f32) {
        self.walker = None;
        self.glide.stop();
        self.pose.frame(bounds, aspect);
    }

    /// Changes the speed by notches of the wheel.
    pub fn change_speed(&mut self, notches: f32) {
        self.speed_factor = (self.speed_factor * NOTCH.powf(notches)).clamp(SPEED_RANGE.0, SPEED_RANGE.1);
    }

    /// Returns the speed without running, m/s.
    #[must_use]
    pub fn speed(&self) -> f32 {
        PACE * self.scale * self.speed_factor * if self.is_walking() { 1.0 } else { FLYING }
    }

    /// Moves for `seconds`, at most a quarter of a second, so that the camera does not leap after a long frame.
    pub fn advance(&mut self, input: MotionInput, seconds: f32, collider: &Collider) {
        let seconds = seconds.min(MAX_FRAME);
        self.pose.turn(input.turn_left * TURN_RATE * seconds, input.turn_up * TURN_RATE * seconds);
        let displacement = self.glide.advance(self.target_velocity(input), seconds);
        match &mut self.walker {
            Some(walker) => {
                walker.advance(displacement, seconds, collider);
                self.pose.position = walker.eye();
            }
            None => self.pose.position += displacement,
        }
    }

    /// Returns true if the camera still moves when no key is held down.
    #[must_use]
    pub fn is_moving(&self) -> bool {
        self.glide.is_moving() || self.walker.as_ref().is_some_and(Walker::is_moving)
    }

    fn walk(&mut self, collider: &Collider) {
        self.walker = Walker::land(Body::of_scale(self.scale), self.pose.position, collider);
        self.glide.stop();
    }

    fn target_velocity(&self, input: MotionInput) -> Vec3 {
        let (ahead, up) = if self.is_walking() { (self.pose.heading(), 0.0) } else { (self.pose.forward(), input.up) };
        let direction = ahead * input.forward + self.pose.right() * input.right + Vec3::Y * up;
        let running = if input.run { RUNNING } else { 1.0 };
        direction.clamp_length_max(1.0) * self.speed() * running
    }
}

/// Error: there is no floor below the camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoFloor;

/// Returns the scale of a person in a scene with these bounds: 1 for diagonals from 3 m to 1000 m. In smaller or larger
/// scenes the person is scaled with the scene.
fn scale_of(bounds: Bounds) -> f32 {
    const SMALLEST: f32 = 3.0;
    const LARGEST: f32 = 1000.0;
    let size = bounds.diagonal().max(1e-4);
    size / size.clamp(SMALLEST, LARGEST)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Material, SceneBuilder};

    /// Builds a square floor of this width at height 0.
    fn floor(width: f32) -> Collider {
        let corners = [(-0.5, -0.5), (-0.5, 0.5), (0.5, 0.5), (0.5, -0.5)];
        let mut builder = SceneBuilder::default();
        let grey = builder.material(Material::diffuse(Vec3::splat(0.5)));
        builder.quad(corners.map(|(x, z)| Vec3::new(x, 0.0, z) * width), grey);
        Collider::new(&builder.build())
    }

    fn at_height(y: f32) -> CameraPose {
        CameraPose::looking_along(Vec3::Y * y, Vec3::NEG_Z)
    }

    const AHEAD: MotionInput =
        MotionInput { forward: 1.0, right: 0.0, up: 0.0, turn_left: 0.0, turn_up: 0.0, run: false };

    #[test]
    fn cameras_at_head_height_walk_and_others_fly() {
        let floor = floor(10.0);
        assert!(CameraController::new(at_height(1.6), &floor).is_walking());
        assert!(!CameraController::new(at_height(3.0), &floor).is_walking());
        assert!(!CameraController::new(at_height(-1.0), &floor).is_walking());
    }

    #[test]
    fn flying_follows_the_viewing_direction_and_walking_the_floor() {
        let floor = floor(20.0);
        let mut controller = CameraController::new(at_height(1.65), &floor);
        controller.pose.turn(0.0, 0.8);
        controller.advance(AHEAD, 0.25, &floor);
        assert!((controller.pose.position.y - 1.65).abs() < 1e-4 && controller.pose.position.z < -0.1);
        assert!(controller.toggle_walking(&floor).is_ok());
        controller.advance(AHEAD, 0.25, &floor);
        assert!(controller.pose.position.y > 1.7, "{}", controller.pose.position);
    }

    #[test]
    fn walking_needs_a_floor() {
        let floor = floor(2.0);
        let mut controller =
            CameraController::new(CameraPose::looking_along(Vec3::new(9.0, 1.6, 0.0), Vec3::X), &floor);
        assert_eq!(controller.toggle_walking(&floor), Err(NoFloor));
        assert!(!controller.is_walking());
    }

    #[test]
    fn walking_is_slower_in_a_doll_house() {
        let eye = |width: f32| at_height(0.005 * width);
        let (room, doll_house) = (floor(10.0), floor(0.1));
        let in_room = CameraController::new(eye(10.0), &room).speed();
        let in_doll_house = CameraController::new(eye(0.1), &doll_house).speed();
        assert!(in_doll_house < 0.1 * in_room, "{in_doll_house} {in_room}");
    }

    #[test]
    fn a_long_frame_does_not_cause_a_leap() {
        let floor = floor(1000.0);
        let mut controller = CameraController::new(at_height(1.65), &floor);
        controller.advance(AHEAD, 100.0, &floor);
        assert!(controller.pose.position.length() < 3.0, "{}", controller.pose.position);
    }

    #[test]
    fn the_speed_stays_in_its_range() {
        let floor = floor(10.0);
        let mut controller = CameraController::new(at_height(1.65), &floor);
        let pace = controller.speed();
        controller.change_speed(1e4);
        assert!(controller.speed() <= 50.1 * pace);
        controller.change_speed(-1e6);
        assert!(controller.speed() >= 0.049 * pace);
    }
}
