//! Moves the eye: flying or walking, at a speed that fits the scene's size.

use glam::Vec3;

use super::camera::{Eye, Glide};
use super::collider::Collider;
use super::walk::{Body, Walker};
use crate::base::bounds::Bounds;

/// Walking pace, metres a second.
const PACE: f32 = 2.0;
/// Flying is this much faster than walking.
const FLYING: f32 = 1.5;
/// Running is this much faster than walking.
const RUNNING: f32 = 2.5;
/// Turn by the arrow keys, radians a second.
const TURN_RATE: f32 = 1.4;
/// One notch of the wheel changes the speed by this factor.
const NOTCH: f32 = 1.15;
/// Slowest and fastest factor that the wheel reaches.
const SPEED_RANGE: (f32, f32) = (0.05, 50.0);
/// Longest time that a single frame moves the eye for, seconds.
const MAX_FRAME: f32 = 0.25;

/// Where the keys want to go; each axis -1..1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Intent {
    /// Along the line of sight.
    pub forward: f32,
    /// To the right.
    pub right: f32,
    /// Upwards; walkers ignore it.
    pub up: f32,
    /// Turn to the left.
    pub turn_left: f32,
    /// Tilt upwards.
    pub turn_up: f32,
    /// Run.
    pub run: bool,
}

impl Intent {
    /// Some key wants to move or turn; running alone is no movement.
    #[must_use]
    pub fn is_moving(&self) -> bool {
        [self.forward, self.right, self.up, self.turn_left, self.turn_up].iter().any(|&axis| axis != 0.0)
    }
}

/// The eye and how it gets about.
pub struct Traveller {
    /// What the picture is seen with.
    pub eye: Eye,
    walker: Option<Walker>,
    glide: Glide,
    /// Length of the scene's own metre, metres.
    scale: f32,
    /// What the wheel chose.
    speed: f32,
}

impl Traveller {
    /// A traveller at `eye`; it walks where the eye is about a person's height above a floor, else it flies.
    #[must_use]
    pub fn new(eye: Eye, collider: &Collider) -> Self {
        let scale = scale_of(collider.bounds());
        let mut traveller = Self { eye, walker: None, glide: Glide::default(), scale, speed: 1.0 };
        let eye_height = Body::of_scale(scale).eye_height;
        let floor = collider.below(eye.position, 1.35 * eye_height);
        if floor.is_some_and(|floor| eye.position.y - floor.height > 0.6 * eye_height) {
            traveller.walk(collider);
        }
        traveller
    }

    /// Feet on the floor.
    #[must_use]
    pub fn is_walking(&self) -> bool {
        self.walker.is_some()
    }

    /// Between walking and flying.
    ///
    /// # Errors
    /// There is no floor below to walk on.
    pub fn toggle_walking(&mut self, collider: &Collider) -> Result<(), NoFloor> {
        if self.walker.take().is_none() {
            self.walk(collider);
            return if self.is_walking() { Ok(()) } else { Err(NoFloor) };
        }
        Ok(())
    }

    /// Jumps to `eye`; a walker that finds itself in the air there flies on.
    pub fn jump(&mut self, eye: Eye, collider: &Collider) {
        let speed = self.speed;
        *self = Self { speed, ..Self::new(eye, collider) };
    }

    /// Stands back, flying, until the whole scene is in view.
    pub fn frame_all(&mut self, collider: &Collider, aspect: f32) {
        self.frame(collider.bounds(), aspect);
    }

    /// Turns about a point, flying.
    pub fn orbit(&mut self, pivot: Vec3, left: f32, up: f32) {
        self.walker = None;
        self.glide.stop();
        self.eye.orbit(pivot, left, up);
    }

    /// Stands back, flying, until a box is in view.
    pub fn frame(&mut self, bounds: Bounds, aspect: f32) {
        self.walker = None;
        self.glide.stop();
        self.eye.frame(bounds, aspect);
    }

    /// Faster or slower by notches of the wheel.
    pub fn change_speed(&mut self, notches: f32) {
        self.speed = (self.speed * NOTCH.powf(notches)).clamp(SPEED_RANGE.0, SPEED_RANGE.1);
    }

    /// Speed without running, metres a second.
    #[must_use]
    pub fn pace(&self) -> f32 {
        PACE * self.scale * self.speed * if self.is_walking() { 1.0 } else { FLYING }
    }

    /// Follows the keys for `seconds`; long frames are cut, so a pause never becomes a leap.
    pub fn advance(&mut self, intent: Intent, seconds: f32, collider: &Collider) {
        let seconds = seconds.min(MAX_FRAME);
        self.eye.turn(intent.turn_left * TURN_RATE * seconds, intent.turn_up * TURN_RATE * seconds);
        let displacement = self.glide.advance(self.wanted_velocity(intent), seconds);
        match &mut self.walker {
            Some(walker) => {
                walker.advance(displacement, seconds, collider);
                self.eye.position = walker.eye();
            }
            None => self.eye.position += displacement,
        }
    }

    /// The eye would move on even if all keys were let go.
    #[must_use]
    pub fn is_moving(&self) -> bool {
        self.glide.is_moving() || self.walker.as_ref().is_some_and(Walker::is_moving)
    }

    fn walk(&mut self, collider: &Collider) {
        self.walker = Walker::land(Body::of_scale(self.scale), self.eye.position, collider);
        self.glide.stop();
    }

    fn wanted_velocity(&self, intent: Intent) -> Vec3 {
        let (ahead, up) = if self.is_walking() { (self.eye.heading(), 0.0) } else { (self.eye.forward(), intent.up) };
        let direction = ahead * intent.forward + self.eye.right() * intent.right + Vec3::Y * up;
        let running = if intent.run { RUNNING } else { 1.0 };
        direction.clamp_length_max(1.0) * self.pace() * running
    }
}

/// There is no floor below the eye.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoFloor;

/// How long a metre seems to be in a scene of this size: rooms and streets are taken to be in metres; a scene too small
/// or too large for a person to walk in gets a person of its own size.
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

    /// A square floor of this width at height 0.
    fn floor(width: f32) -> Collider {
        let corners = [(-0.5, -0.5), (-0.5, 0.5), (0.5, 0.5), (0.5, -0.5)];
        let mut builder = SceneBuilder::default();
        let grey = builder.material(Material::diffuse(Vec3::splat(0.5)));
        builder.quad(corners.map(|(x, z)| Vec3::new(x, 0.0, z) * width), grey);
        Collider::new(&builder.build())
    }

    fn at_height(y: f32) -> Eye {
        Eye::looking_along(Vec3::Y * y, Vec3::NEG_Z)
    }

    const AHEAD: Intent = Intent { forward: 1.0, right: 0.0, up: 0.0, turn_left: 0.0, turn_up: 0.0, run: false };

    #[test]
    fn a_camera_at_head_height_walks_and_one_on_the_ceiling_flies() {
        let floor = floor(10.0);
        assert!(Traveller::new(at_height(1.6), &floor).is_walking());
        assert!(!Traveller::new(at_height(3.0), &floor).is_walking());
        assert!(!Traveller::new(at_height(-1.0), &floor).is_walking());
    }

    #[test]
    fn flying_follows_the_line_of_sight_and_walking_the_floor() {
        let floor = floor(20.0);
        let mut traveller = Traveller::new(at_height(1.65), &floor);
        traveller.eye.turn(0.0, 0.8);
        traveller.advance(AHEAD, 0.25, &floor);
        assert!((traveller.eye.position.y - 1.65).abs() < 1e-4 && traveller.eye.position.z < -0.1);
        assert!(traveller.toggle_walking(&floor).is_ok());
        traveller.advance(AHEAD, 0.25, &floor);
        assert!(traveller.eye.position.y > 1.7, "{}", traveller.eye.position);
    }

    #[test]
    fn walking_needs_a_floor() {
        let floor = floor(2.0);
        let mut traveller = Traveller::new(Eye::looking_along(Vec3::new(9.0, 1.6, 0.0), Vec3::X), &floor);
        assert_eq!(traveller.toggle_walking(&floor), Err(NoFloor));
        assert!(!traveller.is_walking());
    }

    #[test]
    fn a_doll_house_is_walked_at_a_doll_s_pace() {
        let eye = |width: f32| at_height(0.005 * width);
        let (room, doll_house) = (floor(10.0), floor(0.1));
        let in_room = Traveller::new(eye(10.0), &room).pace();
        let in_doll_house = Traveller::new(eye(0.1), &doll_house).pace();
        assert!(in_doll_house < 0.1 * in_room, "{in_doll_house} {in_room}");
    }

    #[test]
    fn a_long_pause_is_no_leap() {
        let floor = floor(1000.0);
        let mut traveller = Traveller::new(at_height(1.65), &floor);
        traveller.advance(AHEAD, 100.0, &floor);
        assert!(traveller.eye.position.length() < 3.0, "{}", traveller.eye.position);
    }

    #[test]
    fn the_wheel_stays_in_its_range() {
        let floor = floor(10.0);
        let mut traveller = Traveller::new(at_height(1.65), &floor);
        let pace = traveller.pace();
        traveller.change_speed(1e4);
        assert!(traveller.pace() <= 50.1 * pace);
        traveller.change_speed(-1e6);
        assert!(traveller.pace() >= 0.049 * pace);
    }
}
