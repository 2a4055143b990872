//! What a picture shows of surfaces and their light, and how bright.

use glam::Vec3;

use super::display::false_colour::LuxScale;
use super::shadow::{ShadowDebug, ShadowSettings};
use crate::base::ids::GroupId;

/// Number of light groups with a weight of their own; further groups take that of the last.
pub const MAX_GROUPS: usize = 8;

/// How bright the picture is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exposure {
    /// Metered from the picture.
    Auto,
    /// Displayed = radiance x 2^EV.
    Ev(f32),
}

/// How radiance beyond white is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ToneMap {
    /// Khronos PBR Neutral (2024): colours below 0.8 of white are unchanged; above it a smooth curve compresses the largest
    /// channel p to 1 - 0.04 / (p - 0.6), and colours fade towards white without a change of hue.
    Neutral,
    /// Clamps each channel at white.
    Linear,
}

/// What is shown of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shading {
    /// The light that it sends: emission and reflection.
    Lit,
    /// The light that it receives, as the radiance of white paint: E / pi.
    IrradianceOnly,
    /// The illuminance that it receives as a colour of [`RenderSettings::lux_scale`], with lines of equal illuminance.
    FalseColour,
    /// Its reflectance, without exposure.
    Albedo,
    /// Its shading normal as the colour 0.5 + 0.5 n, without exposure.
    Normals,
}

impl Shading {
    /// `SHADING` of shaders/surface/pass.wgsl.
    pub(super) fn number(self) -> u32 {
        match self {
            Shading::Lit => 0,
            Shading::IrradianceOnly => 1,
            Shading::Albedo => 2,
            Shading::Normals => 3,
            Shading::FalseColour => 4,
        }
    }
}

/// What a picture shows of surfaces and their light, and how bright.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderSettings {
    /// How bright the picture is.
    pub exposure: Exposure,
    /// How radiance beyond white is shown.
    pub tone_map: ToneMap,
    /// What is shown of a surface.
    pub shading: Shading,
    /// The scale of false colours.
    pub lux_scale: LuxScale,
    /// Factor on direct irradiance.
    pub direct: f32,
    /// Settings of real-time direct light and its shadows; `None` takes direct light from the vertices, as baked.
    pub shadows: Option<ShadowSettings>,
    /// A debug view of the shadow technique over the picture.
    pub shadow_debug: Option<ShadowDebug>,
    /// Factor on indirect irradiance.
    pub indirect: f32,
    /// Radiance of white paint that is added everywhere; it makes unlit scenes visible.
    pub ambient: Vec3,
    /// Factor on the light of each group `[g]` and on the emission of its lamps; groups beyond the end of the list have 1.
    pub group_weights: Vec<Vec3>,
    /// Linear display colour of pixels without a surface; exposure does not change it.
    pub background: Vec3,
    /// Metals are drawn with their base colour as diffuse reflectance, as if their surroundings were even. Physically they
    /// reflect nothing diffusely; false draws them black.
    pub metal_as_diffuse: bool,
    /// Single-sided surfaces are invisible from behind, which opens rooms to views from outside; false draws their backs black.
    pub cull_back: bool,
}

impl Default for RenderSettings {
    fn default() -> Self {
        Self {
            exposure: Exposure::Auto,
            tone_map: ToneMap::Neutral,
            shading: Shading::Lit,
            lux_scale: LuxScale::default(),
            direct: 1.0,
            shadows: None,
            shadow_debug: None,
            indirect: 1.0,
            ambient: Vec3::ZERO,
            group_weights: Vec::new(),
            background: Vec3::splat(0.02),
            metal_as_diffuse: true,
            cull_back: true,
        }
    }
}

impl ToneMap {
    /// `TONE_MAP_...` of shaders/display/display_colour.wgsl.
    pub(super) fn number(self) -> u32 {
        match self {
            ToneMap::Neutral => 0,
            ToneMap::Linear => 1,
        }
    }
}

impl RenderSettings {
    /// The exposure, a factor on radiance; `None` if it is metered.
    #[must_use]
    pub fn fixed_exposure(&self) -> Option<f32> {
        match (self.shading, self.exposure) {
            (Shading::FalseColour | Shading::Albedo | Shading::Normals, _) => Some(1.0),
            (_, Exposure::Ev(ev)) => Some(ev.exp2()),
            (_, Exposure::Auto) => None,
        }
    }

    /// Factor on the light of a group.
    #[must_use]
    pub fn group_weight(&self, group: GroupId) -> Vec3 {
        self.group_weights.get(group.index().min(MAX_GROUPS - 1)).copied().unwrap_or(Vec3::ONE)
    }

    /// The tone map that applies: shadings that do not show light are linear.
    #[must_use]
    pub fn tone_map_in_force(&self) -> ToneMap {
        match self.shading {
            Shading::Lit | Shading::IrradianceOnly => self.tone_map,
            Shading::FalseColour | Shading::Albedo | Shading::Normals => ToneMap::Linear,
        }
    }
}
