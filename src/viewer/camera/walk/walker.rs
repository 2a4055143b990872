//! Movement of the walker: sliding along walls, climbing steps, falling.
//!
//! The body is a stack of collision spheres. The lowest begins one step height above the floor, so low obstacles do not
//! stop it; the rays that find the floor lift the body onto them. Movement is cut into pieces shorter than the radius
//! of the body, so that it passes through no wall, however long a frame takes.

use glam::Vec3;

use super::body::Body;
use crate::viewer::camera::collider::{Collider, Surface};

/// Smallest vertical component of the unit normal of a floor. A walker cannot stand on surfaces steeper than 50
/// degrees.
const MIN_FLOOR_NORMAL: f32 = 0.643;
/// Standard gravity, m/s2.
const GRAVITY: f32 = 9.81;
/// Terminal speed of a fall, m/s.
const MAX_FALL_SPEED: f32 = 50.0;
/// Time constant with which the eye follows the height of a step, seconds.
const STEP_TIME: f32 = 0.06;

/// A walker: the point of the floor below it, and the state of its fall.
#[derive(Clone, Copy, Debug)]
pub struct Walker {
    /// Dimensions of the body.
    pub body: Body,
    feet: Vec3,
    fall_speed: f32,
    is_grounded: bool,
    /// Position when it last stood on a floor.
    safe: Vec3,
    /// Height of the eye above its resting place in the body, metres. The eye follows a step with a delay.
    eye_lag: f32,
}

impl Walker {
    /// Puts a walker on the floor below `eye`; `None` if there is no floor.
    #[must_use]
    pub fn land(body: Body, eye: Vec3, collider: &Collider) -> Option<Self> {
        let floor = collider.below(eye, f32::MAX)?;
        let feet = Vec3::new(eye.x, floor.height, eye.z);
        // The eye moves smoothly from `eye` to its resting place in the body.
        let eye_lag = eye.y - (feet.y + body.eye_height);
        let mut walker = Self { body, feet, fall_speed: 0.0, is_grounded: true, safe: feet, eye_lag };
        walker.feet = walker.pushed_out(feet, collider).unwrap_or(feet);
        Some(walker)
    }

    /// Returns the position of the eye.
    #[must_use]
    pub fn eye(&self) -> Vec3 {
        self.feet + Vec3::Y * (self.body.eye_height + self.eye_lag)
    }

    /// Returns true if the walker falls or the eye still follows a step.
    #[must_use]
    pub fn is_moving(&self) -> bool {
        !self.is_grounded || self.eye_lag != 0.0
    }

    /// Moves by the horizontal part of `displacement` and falls for `seconds`.
    pub fn advance(&mut self, displacement: Vec3, seconds: f32, collider: &Collider) {
        let level = displacement.with_y(0.0);
        let num_pieces = (level.length() / (0.5 * self.body.radius)).ceil().clamp(1.0, 256.0);
        for _ in 0..num_pieces as u32 {
            if level != Vec3::ZERO {
                self.slide(level / num_pieces, collider);
            }
            self.fall(seconds / num_pieces, collider);
        }
        self.return_if_lost(collider);
        self.eye_lag *= (-seconds / STEP_TIME).exp();
        if self.eye_lag.abs() < 1e-3 * self.body.eye_height {
            self.eye_lag = 0.0;
        }
    }

    /// Moves by one piece: forward, then out of walls. The walker slides along a slope that is too steep to climb.
    fn slide(&mut self, piece: Vec3, collider: &Collider) {
        let Some(target) = self.pushed_out(self.feet + piece, collider) else { return };
        if let Some(slope) = self.slope_in_the_way(target, collider) {
            let uphill = slope.normal.with_y(0.0).normalize_or_zero();
            let along = piece - uphill * piece.dot(uphill);
            let beside = self.pushed_out(self.feet + along, collider).filter(|&at| self.has_room(at, collider));
            self.feet = beside.unwrap_or(self.feet);
        } else if self.has_room(target, collider) {
            self.feet = target;
        }
    }

    /// Returns the surface at `feet` if it rises above the floor and is too steep to stand on.
    fn slope_in_the_way(&self, feet: Vec3, collider: &Collider) -> Option<Surface> {
        let from = feet + Vec3::Y * self.body.step;
        let surface = collider.below(from, self.body.step)?;
        (surface.normal.y < MIN_FLOOR_NORMAL && surface.height > feet.y + 0.05 * self.body.step).then_some(surface)
    }

    /// Returns true if the body fits below the ceiling when it stands on the floor at `feet`.
    fn has_room(&self, feet: Vec3, collider: &Collider) -> bool {
        let rise = self.floor_at(feet, self.body.step, collider).map_or(0.0, |floor| (floor.height - feet.y).max(0.0));
        let knee = feet + Vec3::Y * self.body.step;
        rise == 0.0 || collider.above(knee, self.body.height + rise - self.body.step).is_none()
    }

    /// Moves down to the floor by gravity, or up onto a step.
    fn fall(&mut self, seconds: f32, collider: &Collider) {
        let speed = (self.fall_speed + GRAVITY * self.body.scale * seconds).min(MAX_FALL_SPEED * self.body.scale);
        let drop = 0.5 * (self.fall_speed + speed) * seconds;
        // A walker on the floor goes down by up to a step. A falling walker lands on a floor within the drop of this
        // frame.
        let reach = if self.is_grounded { self.body.step } else { drop };
        match self.floor_at(self.feet, self.body.step + reach, collider) {
            Some(floor) => {
                if self.is_grounded {
                    self.eye_lag += self.feet.y - floor.height;
                }
                self.feet.y = floor.height;
                (self.fall_speed, self.is_grounded) = (0.0, true);
                self.safe = self.feet;
            }
            None => {
                self.feet.y -= drop;
                (self.fall_speed, self.is_grounded) = (speed, false);
            }
        }
    }

    /// Returns the highest floor below five points at step height, at most `depth` metres below them.
    fn floor_at(&self, feet: Vec3, depth: f32, collider: &Collider) -> Option<Surface> {
        let knee = feet + Vec3::Y * self.body.step;
        let reach = 0.6 * self.body.radius;
        let offsets = [Vec3::ZERO, Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::NEG_Z];
        let carries = |surface: &Surface| {
            // A surface below the feet ends a fall even if it is too steep to climb.
            surface.normal.y >= MIN_FLOOR_NORMAL || surface.height <= feet.y
        };
        offsets
            .iter()
            .filter_map(|&offset| collider.below(knee + offset * reach, depth))
            .filter(carries)
            .max_by(|a, b| a.height.total_cmp(&b.height))
    }

    /// Returns `feet` moved sideways until the body touches no wall; `None` if the body does not fit between the walls.
    fn pushed_out(&self, feet: Vec3, collider: &Collider) -> Option<Vec3> {
        const MAX_PUSHES: usize = 8;
        let mut free = feet;
        for _ in 0..MAX_PUSHES {
            match self.deepest_push(free, collider) {
                Some(push) => free += push,
                None => return Some(free),
            }
        }
        None
    }

    /// Returns the largest sideways displacement that moves the body out of one surface.
    fn deepest_push(&self, feet: Vec3, collider: &Collider) -> Option<Vec3> {
        let Body { radius, height, step, .. } = self.body;
        let (lowest, highest) = (step + radius, height - radius);
        let num_balls = ((highest - lowest) / radius).ceil() as u32;
        let mut deepest: Option<Vec3> = None;
        for ball in 0..=num_balls {
            let centre = feet + Vec3::Y * (lowest + (highest - lowest) * ball as f32 / num_balls as f32);
            collider.touches(centre, radius, |point| {
                let away = centre - point;
                let level = away.with_y(0.0).length();
                // Floors and ceilings push up and down only. Vertical rays handle them.
                if level < 1e-3 * radius {
                    return;
                }
                let wanted = (radius * radius - away.y * away.y).sqrt();
                let push = away.with_y(0.0) * ((wanted - level) / level);
                let is_deeper = deepest.is_none_or(|other| push.length_squared() > other.length_squared());
                if is_deeper && wanted - level > 1e-3 * radius {
                    deepest = Some(push);
                }
            });
        }
        deepest
    }

    /// Puts the walker back on its last floor after it has fallen out of the scene.
    fn return_if_lost(&mut self, collider: &Collider) {
        if self.feet.y < collider.bounds().low.y - 2.0 * self.body.height {
            (self.feet, self.fall_speed, self.is_grounded, self.eye_lag) = (self.safe, 0.0, true, 0.0);
        }
    }
}
