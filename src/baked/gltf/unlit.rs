//! The appearance in viewers that do not read the stored light: unlit surfaces that show it at one exposure.
//!
//! Equation: COLOR_0 = tone(radiance x 2^EV), without the base colour texture, by which the viewer multiplies. The tone
//! mapping is that of this program, so that pictures look alike.

use std::f32::consts::PI;

use glam::{Vec3, Vec4};

use crate::baked::VertexLight;
use crate::base::colour::neutral;
use crate::scene::{Material, Scene};

/// Light at the vertices, and the exposure at which it is shown.
#[derive(Clone, Copy)]
pub(super) struct UnlitAppearance<'a> {
    /// The light.
    pub light: &'a VertexLight,
    /// Displayed = radiance x exposure.
    pub exposure: f32,
}

impl UnlitAppearance<'_> {
    /// COLOR_0 of a vertex: linear display colour, and alpha of the scene's vertex colour.
    pub fn colour(&self, scene: &Scene, material: &Material, vertex: u32) -> Vec4 {
        let v = vertex as usize;
        let paint = scene.vertices[v].colour;
        let base = (material.base_colour * paint).truncate();
        let irradiance: Vec3 = self.light.groups.iter().map(|group| group.direct[v] + group.indirect[v]).sum();
        let radiance = if material.unlit {
            base
        } else if shows_emission(material) {
            material.emission
        } else {
            material.emission + base * irradiance.max(Vec3::ZERO) / PI
        };
        neutral(radiance * self.exposure).clamp(Vec3::ZERO, Vec3::ONE).extend(paint.w.clamp(0.0, 1.0))
    }
}

/// Returns true if the emissive texture takes the place of the base colour texture. Reflected light is then neglected.
pub(super) fn shows_emission(material: &Material) -> bool {
    material.is_emissive() && material.emissive_texture.is_some() && !material.unlit
}
