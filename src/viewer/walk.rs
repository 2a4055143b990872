//! A person who walks through the scene: gravity, steps, walls to slide along, and no way out of the world.
//!
//! The body is a stack of balls that floats one step height above the floor, so low obstacles pass under it and the
//! rays that look for the floor lift it on to them. Movement is cut into pieces shorter than the body's radius: however
//! long a frame takes, no wall is thin enough to jump through.

use glam::Vec3;

use super::collider::{Collider, Surface};

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
        let (low, _) = collider.bounds();
        if self.feet.y < low.y - 2.0 * self.body.height {
            (self.feet, self.fall_speed, self.is_grounded, self.eye_lag) = (self.safe, 0.0, true, 0.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::{Vec2, Vec4};

    use super::*;
    use crate::base::ids::{InstanceId, MaterialId};
    use crate::scene::{Scene, Triangle, Vertex};

    const FRAME: f32 = 1.0 / 60.0;

    /// Quads, corner by corner.
    fn world(quads: &[[Vec3; 4]]) -> Collider {
        let mut scene = Scene::default();
        for &quad in quads {
            let first = scene.vertices.len() as u32;
            scene.vertices.extend(quad.map(|position| Vertex {
                position,
                normal: Vec3::Y,
                uv: [Vec2::ZERO; 2],
                colour: Vec4::ONE,
            }));
            scene.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|corners| Triangle {
                vertices: corners.map(|corner| first + corner),
                material: MaterialId(0),
                instance: InstanceId(0),
                is_back_side: false,
            }));
        }
        Collider::new(&scene)
    }

    /// A level rectangle at height `y`.
    fn level(y: f32, x: [f32; 2], z: [f32; 2]) -> [Vec3; 4] {
        [(0, 1), (1, 1), (1, 0), (0, 0)].map(|(i, j)| Vec3::new(x[i], y, z[j]))
    }

    /// An upright wall across the way at `z`.
    fn wall(z: f32, x: [f32; 2], y: [f32; 2]) -> [Vec3; 4] {
        [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(i, j)| Vec3::new(x[i], y[j], z))
    }

    fn floor() -> [Vec3; 4] {
        level(0.0, [-10.0, 10.0], [-10.0, 10.0])
    }

    fn walker(at: Vec3, collider: &Collider) -> Walker {
        Walker::land(Body::of_scale(1.0), at + Vec3::Y * 1.65, collider).expect("a floor")
    }

    /// Walks at `velocity` for `seconds` in frames of `frame` seconds.
    fn walk(walker: &mut Walker, velocity: Vec3, seconds: f32, frame: f32, collider: &Collider) {
        for _ in 0..(seconds / frame).round() as usize {
            walker.advance(velocity * frame, frame, collider);
        }
    }

    #[test]
    fn the_eye_keeps_its_height_above_the_floor() {
        let world = world(&[floor()]);
        let mut walker = walker(Vec3::ZERO, &world);
        walk(&mut walker, Vec3::new(1.5, 0.0, 1.0), 2.0, FRAME, &world);
        assert!((walker.eye() - Vec3::new(3.0, 1.65, 2.0)).length() < 1e-3, "{}", walker.eye());
        assert!(!walker.is_moving());
    }

    #[test]
    fn somebody_who_is_dropped_lands_on_the_floor() {
        let world = world(&[floor(), level(3.0, [-1.0, 1.0], [-1.0, 1.0])]);
        let mut walker = walker(Vec3::new(0.0, 3.0, 0.0), &world);
        walk(&mut walker, Vec3::X * 2.0, 1.0, FRAME, &world);
        assert!(walker.is_moving() && walker.eye().y < 4.65 && walker.eye().y > 1.65, "{}", walker.eye());
        walk(&mut walker, Vec3::ZERO, 2.0, FRAME, &world);
        assert!((walker.eye().y - 1.65).abs() < 1e-4, "{}", walker.eye());
    }

    #[test]
    fn a_wall_stops_the_way_ahead_and_leaves_the_way_along() {
        let world = world(&[floor(), wall(-2.0, [-10.0, 10.0], [0.0, 3.0])]);
        let mut walker = walker(Vec3::ZERO, &world);
        walk(&mut walker, Vec3::new(1.0, 0.0, -2.0), 4.0, FRAME, &world);
        let eye = walker.eye();
        assert!((eye.z + 1.75).abs() < 0.01, "a body's radius from the wall, not {eye}");
        assert!((eye.x - 4.0).abs() < 0.05, "{eye}");
    }

    #[test]
    fn no_wall_is_too_thin_for_a_slow_computer() {
        let world = world(&[floor(), wall(-2.0, [-10.0, 10.0], [0.0, 3.0])]);
        for frame in [0.25, 1.0] {
            let mut walker = walker(Vec3::ZERO, &world);
            walk(&mut walker, Vec3::NEG_Z * 12.0, 2.0, frame, &world);
            assert!(walker.eye().z > -2.0, "{frame}: {}", walker.eye());
        }
    }

    #[test]
    fn a_corner_holds_from_both_sides() {
        let side =
            [Vec3::new(2.0, 0.0, -5.0), Vec3::new(2.0, 0.0, 5.0), Vec3::new(2.0, 3.0, 5.0), Vec3::new(2.0, 3.0, -5.0)];
        let world = world(&[floor(), wall(-2.0, [-10.0, 10.0], [0.0, 3.0]), side]);
        let mut walker = walker(Vec3::ZERO, &world);
        walk(&mut walker, Vec3::new(3.0, 0.0, -3.0), 3.0, FRAME, &world);
        let eye = walker.eye();
        assert!((eye.x - 1.75).abs() < 0.02 && (eye.z + 1.75).abs() < 0.02, "{eye}");
    }

    /// Six steps up to a landing, beginning at z = -1.
    fn stairs(rise: f32) -> Vec<[Vec3; 4]> {
        let mut quads = vec![floor()];
        for step in 0..6 {
            let (z, y) = (-1.0 - 0.3 * step as f32, rise * step as f32);
            quads.push(wall(z, [-1.0, 1.0], [y, y + rise]));
            quads.push(level(y + rise, [-1.0, 1.0], [z - if step == 5 { 4.0 } else { 0.3 }, z]));
        }
        quads
    }

    #[test]
    fn stairs_are_climbed_and_descended_at_any_frame_rate() {
        let world = world(&stairs(0.18));
        for frame in [FRAME, 0.1, 0.25] {
            let mut walker = walker(Vec3::ZERO, &world);
            walk(&mut walker, Vec3::NEG_Z * 2.0, 2.0, frame, &world);
            walk(&mut walker, Vec3::ZERO, 1.0, frame, &world);
            assert!(
                (walker.eye() - Vec3::new(0.0, 6.0 * 0.18 + 1.65, -4.0)).length() < 0.02,
                "{frame}: {}",
                walker.eye()
            );
            walk(&mut walker, Vec3::Z * 2.0, 2.0, frame, &world);
            walk(&mut walker, Vec3::ZERO, 1.0, frame, &world);
            assert!((walker.eye() - Vec3::Y * 1.65).length() < 0.02, "{frame}: {}", walker.eye());
        }
    }

    #[test]
    fn the_eye_rises_smoothly_on_stairs() {
        let world = world(&stairs(0.18));
        let mut walker = walker(Vec3::ZERO, &world);
        let mut last = walker.eye().y;
        for _ in 0..120 {
            walker.advance(Vec3::NEG_Z * 2.0 * FRAME, FRAME, &world);
            assert!(walker.eye().y - last < 0.06, "a jump of {}", walker.eye().y - last);
            last = walker.eye().y;
        }
    }

    #[test]
    fn what_is_higher_than_a_step_is_a_wall() {
        let world = world(&stairs(0.6));
        let mut walker = walker(Vec3::ZERO, &world);
        walk(&mut walker, Vec3::NEG_Z * 2.0, 3.0, FRAME, &world);
        assert!((walker.eye().y - 1.65).abs() < 1e-3 && walker.eye().z > -0.9, "{}", walker.eye());
    }

    #[test]
    fn a_step_below_a_low_ceiling_is_not_taken() {
        let mut quads = stairs(0.3);
        quads.push(level(1.9, [-1.0, 1.0], [-4.0, -0.5]));
        let world = world(&quads);
        let mut walker = walker(Vec3::ZERO, &world);
        walk(&mut walker, Vec3::NEG_Z * 2.0, 2.0, FRAME, &world);
        assert!(walker.eye().y < 1.9, "{}", walker.eye());
    }

    #[test]
    fn a_ramp_is_walked_and_a_cliff_is_not() {
        let ramp = |height: f32| {
            let (low, high) = ([-10.0, 10.0], height);
            [
                Vec3::new(low[0], 0.0, -1.0),
                Vec3::new(low[1], 0.0, -1.0),
                Vec3::new(low[1], high, -3.0),
                Vec3::new(low[0], high, -3.0),
            ]
        };
        for (height, is_walkable) in [(1.0, true), (2.0, true), (3.2, false), (8.0, false)] {
            let world = world(&[floor(), ramp(height)]);
            let mut walker = walker(Vec3::ZERO, &world);
            walk(&mut walker, Vec3::NEG_Z * 2.0, 1.25, FRAME, &world);
            assert_eq!(walker.eye().y > 1.65 + 0.3 * height, is_walkable, "{height}: {}", walker.eye());
        }
    }

    #[test]
    fn a_gap_that_is_wide_enough_is_a_door() {
        let world = world(&[floor(), wall(-2.0, [-10.0, -0.3], [0.0, 3.0]), wall(-2.0, [0.3, 10.0], [0.0, 3.0])]);
        let mut walker = walker(Vec3::new(0.2, 0.0, 0.0), &world);
        walk(&mut walker, Vec3::NEG_Z * 2.0, 2.0, FRAME, &world);
        assert!(walker.eye().z < -3.0, "{}", walker.eye());
    }

    #[test]
    fn nobody_falls_out_of_the_world() {
        let world = world(&[level(0.0, [-1.0, 1.0], [-1.0, 1.0])]);
        let mut walker = walker(Vec3::ZERO, &world);
        walk(&mut walker, Vec3::X * 2.0, 1.0, FRAME, &world);
        walk(&mut walker, Vec3::ZERO, 10.0, FRAME, &world);
        assert!((walker.eye().y - 1.65).abs() < 1e-3, "{}", walker.eye());
        assert!(walker.eye().x.abs() < 1.3, "{}", walker.eye());
    }

    #[test]
    fn there_is_no_walking_without_a_floor() {
        let world = world(&[level(0.0, [-1.0, 1.0], [-1.0, 1.0])]);
        assert!(Walker::land(Body::of_scale(1.0), Vec3::new(5.0, 1.0, 0.0), &world).is_none());
    }
}
