//! A light sample: a point or direction from which light comes, with one hard shadow.

use glam::{Vec3, Vec4};

use crate::scene::{Light, LightKind};

/// `GRAZING_COSINE` of shaders/shadow/light/light_sample.wgsl: light at a lower cosine counts as zero.
pub const GRAZING_COSINE: f32 = 1e-4;

/// One point or direction from which light comes.
#[derive(Clone, Debug, PartialEq)]
pub struct LightSample {
    /// Position and intensity. A sample of a surface is a point light; its intensity is that along the normal.
    pub light: Light,
    /// Normal of the emissive surface that this is a sample of, if any. It emits on that side only, in proportion to
    /// the cosine.
    pub surface_normal: Option<Vec3>,
    /// Index of the lamp of this sample: punctual lights come first, then emissive surfaces.
    pub lamp: usize,
}

impl LightSample {
    /// Returns the homogeneous position: a point with w = 1, or the direction towards the light with w = 0.
    #[must_use]
    pub fn position(&self) -> Vec4 {
        match self.light.kind {
            LightKind::Point { position } | LightKind::Spot { position, .. } => position.extend(1.0),
            LightKind::Directional { direction } => (-direction).extend(0.0),
        }
    }

    /// Returns the unshadowed irradiance on a surface at `point` with unit normal `normal`, lux per channel.
    #[must_use]
    pub fn irradiance(&self, point: Vec3, normal: Vec3) -> Vec3 {
        let arrival = self.light.arrival(point);
        let cosine = normal.dot(arrival.to_light);
        let emitted = self.surface_normal.map_or(1.0, |axis| axis.dot(-arrival.to_light));
        if cosine <= GRAZING_COSINE || emitted <= GRAZING_COSINE {
            return Vec3::ZERO;
        }
        arrival.irradiance * (cosine * emitted)
    }
}
