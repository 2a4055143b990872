//! Punctual lights (KHR_lights_punctual): no size, no patch; their first bounce is injected as direct irradiance.

use glam::Vec3;

use super::photometry::Profile;
use crate::base::ids::GroupId;

/// A punctual light placed in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Name of its node or of the light.
    pub name: String,
    /// Kind and place.
    pub kind: LightKind,
    /// Colour times intensity per channel: candela for point and spot, lux for directional; the largest of a [`Profile`].
    pub intensity: Vec3,
    /// Distance at which it ends, metres; none means never.
    pub range: Option<f32>,
    /// How a point light's intensity depends on direction; none is the same everywhere.
    pub profile: Option<Profile>,
    /// The group that dims it.
    pub group: GroupId,
}

/// Kinds of punctual light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// Shines everywhere from a point.
    Point {
        /// Metres.
        position: Vec3,
    },
    /// Shines in a cone.
    Spot {
        /// Metres.
        position: Vec3,
        /// Unit axis, away from the light.
        direction: Vec3,
        /// Half angle where the falloff begins, radians.
        inner_angle: f32,
        /// Half angle where the light ends, radians.
        outer_angle: f32,
    },
    /// Shines from infinity.
    Directional {
        /// Unit vector in which the light travels.
        direction: Vec3,
    },
}

/// Light that would arrive at a point if nothing stood between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    /// Unit vector from the point towards the light.
    pub to_light: Vec3,
    /// Distance to the light, metres; infinite for directional.
    pub distance: f32,
    /// Irradiance on a surface that faces the light, lux per channel.
    pub irradiance: Vec3,
}

impl Light {
    /// Unoccluded arrival at `point`, before the receiver's cosine.
    ///
    /// Equation: E = I / r^2 x (cone or share of a photometric table) x window, with the cone and range formulas of KHR_lights_punctual.
    #[must_use]
    pub fn arrival(&self, point: Vec3) -> Arrival {
        match self.kind {
            LightKind::Directional { direction } => {
                Arrival { to_light: -direction, distance: f32::INFINITY, irradiance: self.intensity }
            }
            LightKind::Point { position } => self.arrival_from(position, point, |to_light| {
                self.profile.as_ref().map_or(1.0, |profile| profile.share(-to_light))
            }),
            LightKind::Spot { position, direction, inner_angle, outer_angle } => {
                self.arrival_from(position, point, |to_light| {
                    let cos_outer = outer_angle.cos();
                    let scale = 1.0 / (inner_angle.cos() - cos_outer).max(1e-3);
                    let share = ((-to_light).dot(direction) * scale - cos_outer * scale).clamp(0.0, 1.0);
                    share * share
                })
            }
        }
    }

    fn arrival_from(&self, position: Vec3, point: Vec3, cone: impl Fn(Vec3) -> f32) -> Arrival {
        let offset = position - point;
        let distance = offset.length();
        if distance <= 0.0 {
            return Arrival { to_light: Vec3::Y, distance: 0.0, irradiance: Vec3::ZERO };
        }
        let to_light = offset / distance;
        let window = match self.range {
            Some(range) => (1.0 - (distance / range).powi(4)).clamp(0.0, 1.0),
            None => 1.0,
        };
        let irradiance = self.intensity * (window * cone(to_light) / (distance * distance));
        Arrival { to_light, distance, irradiance }
    }
}
