//! Smooth acceleration of the camera.

use glam::Vec3;

/// Time constant T, seconds: the time in which a velocity covers 63 % of the way to its target.
const GLIDE_TIME: f32 = 0.07;

/// A velocity that approaches its target exponentially.
///
/// Equation: dv/dt = (target - v) / T, integrated exactly, so that the path does not depend on the frame rate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Glide {
    velocity: Vec3,
}

impl Glide {
    /// Returns the displacement, metres, over `seconds` with a constant `target` velocity, m/s.
    pub fn advance(&mut self, target: Vec3, seconds: f32) -> Vec3 {
        let kept = (-seconds / GLIDE_TIME).exp();
        let gap = self.velocity - target;
        self.velocity = target + gap * kept;
        if target == Vec3::ZERO && self.velocity.length_squared() < 1e-3 * gap.length_squared().max(1e-3) {
            self.velocity = Vec3::ZERO;
        }
        target * seconds + gap * (GLIDE_TIME * (1.0 - kept))
    }

    /// Returns true if the velocity is not zero.
    #[must_use]
    pub fn is_moving(&self) -> bool {
        self.velocity != Vec3::ZERO
    }

    /// Sets the velocity to zero at once.
    pub fn stop(&mut self) {
        self.velocity = Vec3::ZERO;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_path_does_not_depend_on_the_frame_rate() {
        let run = |frames: u32| {
            let mut glide = Glide::default();
            let step = 0.5 / frames as f32;
            (0..frames).map(|_| glide.advance(Vec3::new(3.0, 0.0, -1.0), step)).sum::<Vec3>()
        };
        assert!((run(1) - run(50)).length() < 1e-4, "{} {}", run(1), run(50));
    }

    #[test]
    fn the_velocity_reaches_zero() {
        let mut glide = Glide::default();
        glide.advance(Vec3::X, 1.0);
        for _ in 0..60 {
            glide.advance(Vec3::ZERO, 1.0 / 60.0);
        }
        assert!(!glide.is_moving());
    }
}
