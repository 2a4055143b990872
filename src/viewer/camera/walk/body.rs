//! Dimensions of the person who walks.

/// Height of the eyes above the floor, metres.
const EYE_HEIGHT: f32 = 1.65;
/// Height of the top of the head above the floor, metres.
const HEAD_HEIGHT: f32 = 1.75;
/// Radius of the body, metres.
const RADIUS: f32 = 0.25;
/// Highest step that is climbed without a jump, metres.
const STEP: f32 = 0.4;

/// Dimensions of a walker, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Radius of the collision spheres of the body.
    pub radius: f32,
    /// Height of the eyes above the floor.
    pub eye_height: f32,
    /// Height of the top of the head above the floor.
    pub height: f32,
    /// Highest step that is climbed without a jump.
    pub step: f32,
    /// Scale of the body. Gravity is multiplied by it too, so a fall by one body height takes the same time at every
    /// scale.
    pub scale: f32,
}

impl Body {
    /// Returns the dimensions of an adult, multiplied by `scale`.
    #[must_use]
    pub fn of_scale(scale: f32) -> Self {
        Self {
            radius: RADIUS * scale,
            eye_height: EYE_HEIGHT * scale,
            height: HEAD_HEIGHT * scale,
            step: STEP * scale,
            scale,
        }
    }
}
