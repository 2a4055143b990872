//! Punctual lights (KHR_lights_punctual) and the irradiance that arrives from them.
//!
//! A punctual light has no area, so it is no patch of the radiosity system. Its direct irradiance is computed at the
//! receivers; radiosity then distributes the reflected light.

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
    /// Colour times intensity per channel: candela for point and spot, lux for directional; with a [`Profile`], the
    /// largest intensity over all directions.
    pub intensity: Vec3,
    /// Distance beyond which no light arrives, metres; `None` for an unlimited range.
    pub range: Option<f32>,
    /// Directional distribution of a point light's intensity; `None` for the same intensity in all directions.
    pub profile: Option<Profile>,
    /// The light group in which it is dimmed.
    pub group: GroupId,
}

/// Kinds of punctual light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// Emits from a point in all directions.
    Point {
        /// Position of the light, metres.
        position: Vec3,
    },
    /// Emits from a point in a cone.
    Spot {
        /// Position of the light, metres.
        position: Vec3,
        /// Unit axis, away from the light.
        direction: Vec3,
        /// Half angle at which the falloff begins, radians.
        inner_angle: f32,
        /// Half angle of the cone, beyond which nothing is emitted, radians.
        outer_angle: f32,
    },
    /// Parallel light from infinity.
    Directional {
        /// Unit vector in which the light travels.
        direction: Vec3,
    },
}

/// Light that arrives at a point if no surface blocks it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    /// Unit vector from the point towards the light.
    pub to_light: Vec3,
    /// Distance to the light, metres; infinite for directional.
    pub distance: f32,
    /// Irradiance on a surface perpendicular to the light, lux per channel.
    pub irradiance: Vec3,
}

impl Light {
    /// Returns a light without name, range limit and profile, in light group 0. `intensity` is in candela, or in lux
    /// for a directional light.
    #[must_use]
    pub fn new(kind: LightKind, intensity: Vec3) -> Self {
        Self { name: String::new(), kind, intensity, range: None, profile: None, group: GroupId(0) }
    }

    /// Returns a point light of `intensity` candela per channel.
    #[must_use]
    pub fn point(position: Vec3, intensity: Vec3) -> Self {
        Self::new(LightKind::Point { position }, intensity)
    }

    /// Returns a spot light of `intensity` candela per channel along the unit vector `direction`, with the half angles
    /// at which the falloff begins and at which the cone ends, radians.
    #[must_use]
    pub fn spot(position: Vec3, direction: Vec3, [inner_angle, outer_angle]: [f32; 2], intensity: Vec3) -> Self {
        Self::new(LightKind::Spot { position, direction, inner_angle, outer_angle }, intensity)
    }

    /// Parallel light that travels along the unit vector `direction`, with `illuminance` lux per channel on a surface
    /// perpendicular to it.
    #[must_use]
    pub fn directional(direction: Vec3, illuminance: Vec3) -> Self {
        Self::new(LightKind::Directional { direction }, illuminance)
    }

    /// Returns the light that arrives at `point` if no surface blocks it, without the cosine factor of the receiver.
    ///
    /// For point and spot lights, E = I / r^2 x a x w, where a is the attenuation by the spot's cone, or the relative
    /// intensity of the photometric profile, and w = clamp(1 - (r / range)^4, 0, 1) brings the light to zero at its
    /// range.
    ///
    /// Source: KHR_lights_punctual, sections "Inner and Outer Cone Angles" and "Range Property".
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
