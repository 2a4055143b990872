//! Settings of a picture: which quantity of the surfaces it shows, and how bright.

use glam::Vec3;

use super::display::false_colour::LuxScale;
use super::shadow::{ShadowDebug, ShadowSettings};
use crate::base::ids::GroupId;

/// Number of light groups with a weight of their own; further groups have the weight of the last.
pub const MAX_GROUPS: usize = 8;

/// Exposure of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exposure {
    /// Metered from the picture.
    Auto,
    /// Displayed = radiance x 2^EV.
    Ev(f32),
}

/// Curve that maps radiance to display colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ToneMap {
    /// Khronos PBR Neutral (2024): colours below 0.8 of white are unchanged; above it a smooth curve compresses the
    /// largest channel p to 1 - 0.04 / (p - 0.6), and colours fade towards white without a change of hue.
    Neutral,
    /// Clamps each channel at white.
    Linear,
}

/// Quantity of a surface that the picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shading {
    /// Light that it sends: emission and reflection.
    Lit,
    /// Light that it receives, as the radiance of white paint: E / pi.
    IrradianceOnly,
    /// Illuminance that it receives, as a colour of [`RenderSettings::lux_scale`] with lines of equal illuminance.
    FalseColour,
    /// Its reflectance, without exposure.
    Albedo,
    /// Its shading normal as the colour 0.5 + 0.5 n, without exposure.
    Normals,
}

impl Shading {
    /// Returns the value of `SHADING` in shaders/surface/pass.wgsl.
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

/// Settings of a picture: which quantity of the surfaces it shows, and how bright.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderSettings {
    /// Exposure of the picture.
    pub exposure: Exposure,
    /// Curve that maps radiance to display colours.
    pub tone_map: ToneMap,
    /// Quantity of a surface that the picture shows.
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
    /// Radiance of white paint that is added everywhere, so that unlit scenes are visible.
    pub ambient: Vec3,
    /// Factor on the light of each group `[g]` and on the emission of its lamps. Groups beyond the end of the list have
    /// the factor 1.
    pub group_weights: Vec<Vec3>,
    /// Linear display colour of pixels without a surface; exposure does not change it.
    pub background: Vec3,
    /// True if metals reflect their base colour diffusely, as if their surroundings were uniform. False draws them
    /// black: a physical metal reflects nothing diffusely.
    pub metal_as_diffuse: bool,
    /// True if single-sided surfaces are invisible from behind, which opens rooms to views from outside. False draws
    /// their backs black.
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
    /// Returns the value of `TONE_MAP_...` in shaders/display/display_colour.wgsl.
    pub(super) fn number(self) -> u32 {
        match self {
            ToneMap::Neutral => 0,
            ToneMap::Linear => 1,
        }
    }
}

impl RenderSettings {
    /// Returns the exposure, a factor on radiance; `None` if it is metered.
    #[must_use]
    pub fn fixed_exposure(&self) -> Option<f32> {
        match (self.shading, self.exposure) {
            (Shading::FalseColour | Shading::Albedo | Shading::Normals, _) => Some(1.0),
            (_, Exposure::Ev(ev)) => Some(ev.exp2()),
            (_, Exposure::Auto) => None,
        }
    }

    /// Returns the factor on the light of a group.
    #[must_use]
    pub fn group_weight(&self, group: GroupId) -> Vec3 {
        self.group_weights.get(group.index().min(MAX_GROUPS - 1)).copied().unwrap_or(Vec3::ONE)
    }

    /// Returns the tone map that applies. It is linear for shadings that do not show light.
    #[must_use]
    pub fn tone_map_in_force(&self) -> ToneMap {
        match self.shading {
            Shading::Lit | Shading::IrradianceOnly => self.tone_map,
            Shading::FalseColour | Shading::Albedo | Shading::Normals => ToneMap::Linear,
        }
    }
}
