//! A person who walks through the scene: gravity, steps, walls to slide along, and no way out of the world.
//!
//! The body is a stack of balls that floats one step height above the floor, so low obstacles pass under it and the
//! rays that look for the floor lift it on to them. Movement is cut into pieces shorter than the body's radius: however
//! long a frame takes, no wall is thin enough to jump through.

use glam::Vec3;

use crate::viewer::collider::{Collider, Surface};

/// Steepest floor that carries a walker, as the height of its unit normal (50 degrees).
const MIN_FLOOR_NORMAL: f32 = 0.643;
/// Standard gravity, m/s2.
const GRAVITY: f32 = 9.81;
/// Air stops a fall from getting any faster, m/s.
const MAX_FALL_SPEED: f32 = 50.0;
/// Time in which the eye takes up 63 % of a step's height, seconds.
const STEP_TIME: f32 = 0.06;

/// Measures of a walker, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Of the balls it is made of.
    pub radius: f32,
    /// Of the eye above the floor.
    pub eye_height: f32,
    /// From the floor to the crown.
    pub height: f32,
    /// Highest step it takes in its stride.
    pub step: f32,
    /// Factor on gravity, so that a fall looks alike at every scale.
    pub scale: f32,
}

impl Body {
    /// A grown person in a scene whose metre is `scale` metres long.
    #[must_use]
    pub fn of_scale(scale: f32) -> Self {
        Self { radius: 0.25 * scale, eye_height: 1.65 * scale, height: 1.75 * scale, step: 0.4 * scale, scale }
    }
}

/// A walker: the point of the floor it stands on, and its fall.
#[derive(Clone, Copy, Debug)]
pub struct Walker {
    /// Measures.
    pub body: Body,
    feet: Vec3,
    fall_speed: f32,
    is_grounded: bool,
    /// Where it last stood on a floor.
    safe: Vec3,
    /// What the eye is behind the body after a step, metres.
    eye_lag: f32,
}

impl Walker {
    /// Sets a walker on the floor below `eye`; none where there is no floor.
    #[must_use]
    pub fn land(body: Body, eye: Vec3, collider: &Collider) -> Option<Self> {
        let floor = collider.below(eye, f32::MAX)?;
        let feet = Vec3::new(eye.x, floor.height, eye.z);
        // The eye sinks or rises smoothly from where it is.
        let eye_lag = eye.y - (feet.y + body.eye_height);
        let mut walker = Self { body, feet, fall_speed: 0.0, is_grounded: true, safe: feet, eye_lag };
        walker.feet = walker.pushed_out(feet, collider).unwrap_or(feet);
        Some(walker)
    }

    /// The eye point.
    #[must_use]
    pub fn eye(&self) -> Vec3 {
        self.feet + Vec3::Y * (self.body.eye_height + self.eye_lag)
    }

    /// Falling, or the eye still catches up with a step.
    #[must_use]
    pub fn is_moving(&self) -> bool {
        !self.is_grounded || self.eye_lag != 0.0
    }

    /// Moves by `displacement` along the floor (its height is ignored) and falls for `seconds`.
    pub fn advance(&mut self, displacement: Vec3, seconds: f32, collider: &Collider) {
        let level = displacement.with_y(0.0);
        let num_pieces = (level.length() / (0.5 * self.body.radius)).ceil().clamp(1.0, 256.0);
        for _ in 0..num_pieces as u32 {
            if level != Vec3::ZERO {
                self.slide(level / num_pieces, collider);
            }
            self.fall(seconds / num_pieces, collider);
        }
        self.return_from_the_void(collider);
        self.eye_lag *= (-seconds / STEP_TIME).exp();
        if self.eye_lag.abs() < 1e-3 * self.body.eye_height {
            self.eye_lag = 0.0;
        }
    }

    /// One piece of the way: forward, out of the walls, up the steps, along what is too steep.
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

    /// A slope at `feet` that rises above the floor and is too steep to stand on.
    fn slope_in_the_way(&self, feet: Vec3, collider: &Collider) -> Option<Surface> {
        let from = feet + Vec3::Y * self.body.step;
        let surface = collider.below(from, self.body.step)?;
        (surface.normal.y < MIN_FLOOR_NORMAL && surface.height > feet.y + 0.05 * self.body.step).then_some(surface)
    }

    /// The head does not meet the ceiling when the body stands on the floor at `feet`.
    fn has_room(&self, feet: Vec3, collider: &Collider) -> bool {
        let rise = self.floor_at(feet, self.body.step, collider).map_or(0.0, |floor| (floor.height - feet.y).max(0.0));
        let knee = feet + Vec3::Y * self.body.step;
        rise == 0.0 || collider.above(knee, self.body.height + rise - self.body.step).is_none()
    }

    /// Down to the floor, or up on to a step.
    fn fall(&mut self, seconds: f32, collider: &Collider) {
        let speed = (self.fall_speed + GRAVITY * self.body.scale * seconds).min(MAX_FALL_SPEED * self.body.scale);
        let drop = 0.5 * (self.fall_speed + speed) * seconds;
        // A walker keeps its feet on the stairs; somebody who falls already only lands where the fall ends.
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

    /// The highest floor below the knees at five points of the sole, at most `depth` metres below the knees.
    fn floor_at(&self, feet: Vec3, depth: f32, collider: &Collider) -> Option<Surface> {
        let knee = feet + Vec3::Y * self.body.step;
        let reach = 0.6 * self.body.radius;
        let sole = [Vec3::ZERO, Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::NEG_Z];
        let carries = |surface: &Surface| {
            // Too steep to climb, yet it ends a fall.
            surface.normal.y >= MIN_FLOOR_NORMAL || surface.height <= feet.y
        };
        sole.iter()
            .filter_map(|&offset| collider.below(knee + offset * reach, depth))
            .filter(carries)
            .max_by(|a, b| a.height.total_cmp(&b.height))
    }

    /// `feet` moved sideways until the body touches no wall; none where it is wedged in.
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

    /// The largest sideways push that any surface asks for.
    fn deepest_push(&self, feet: Vec3, collider: &Collider) -> Option<Vec3> {
        let Body { radius, height, step, .. } = self.body;
        let (lowest, highest) = (step + radius, height - radius);
        let num_balls = ((highest - lowest) / radius).ceil() as u32;
        let mut deepest: Option<Vec3> = None;
        for ball in 0..=num_balls {
            let centre = feet + Vec3::Y * (lowest + (highest - lowest) * ball as f32 / num_balls as f32);
            collider.touches(centre, radius, |touch| {
                let away = centre - touch.point;
                let level = away.with_y(0.0).length();
                // Floors and ceilings push up or down only: the rays see to them.
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

    fn return_from_the_void(&mut self, collider: &Collider) {
        if self.feet.y < collider.bounds().low.y - 2.0 * self.body.height {
            (self.feet, self.fall_speed, self.is_grounded, self.eye_lag) = (self.safe, 0.0, true, 0.0);
        }
    }
}

#[cfg(test)]
mod tests;
