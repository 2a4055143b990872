//! How a picture of the same light is to look.

use glam::Vec3;

use super::display::false_colour::LuxScale;
use super::shadow::{ShadowDebug, ShadowSettings};
use crate::base::ids::GroupId;

/// Light groups that can be weighted; those beyond follow the last.
pub const MAX_GROUPS: usize = 8;

/// How bright the picture is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exposure {
    /// Metered from the picture itself.
    Auto,
    /// Displayed = radiance x 2^EV.
    Ev(f32),
}

/// How radiance beyond white is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ToneMap {
    /// Khronos PBR Neutral: true colours up to 0.8 of white, highlights roll off without a change of hue.
    Neutral,
    /// Cut off at white.
    Linear,
}

/// What is shown of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shading {
    /// The light it sends: emission and reflection.
    Lit,
    /// The light it receives, as ideal white paint would show it: E / pi.
    IrradianceOnly,
    /// The illuminance that it receives as a colour of [`RenderSettings::lux_scale`], with lines of equal illuminance.
    FalseColour,
    /// Its reflectance, shown as it is, without exposure.
    Albedo,
    /// Its shading normal, 0.5 + 0.5 n, shown as it is.
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

/// How a picture of the same light is to look.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderSettings {
    /// How bright the picture is.
    pub exposure: Exposure,
    /// How radiance beyond white is shown.
    pub tone_map: ToneMap,
    /// What is shown of a surface.
    pub shading: Shading,
    /// Which illuminance has which false colour.
    pub lux_scale: LuxScale,
    /// Factor on direct irradiance.
    pub direct: f32,
    /// Direct light comes from the lights themselves, with these shadows; none: it comes from the vertices, as baked.
    pub shadows: Option<ShadowSettings>,
    /// What shadows work with is drawn over the picture.
    pub shadow_debug: Option<ShadowDebug>,
    /// Factor on indirect irradiance.
    pub indirect: f32,
    /// Radiance that ideal white paint shows everywhere in addition: it makes unlit scenes visible.
    pub ambient: Vec3,
    /// Factor on the light of each group `[g]`, and on the glow of its lamps; 1 where the list ends early.
    pub group_weights: Vec<Vec3>,
    /// Linear display colour where nothing is seen, untouched by exposure.
    pub background: Vec3,
    /// Metals, which reflect nothing diffusely and would be black, are shown as if their surroundings were even: with
    /// their base colour as reflectance. False shows only the light that was solved.
    pub metal_as_diffuse: bool,
    /// Single-sided surfaces are invisible from behind, so that one can look into a room from outside; false shows
    /// their backs black, as light meets them.
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
    /// Factor of displayed colour on radiance, or none where it is to be metered.
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

    /// The tone map in force: what is no light is shown as it is.
    #[must_use]
    pub fn tone_map_in_force(&self) -> ToneMap {
        match self.shading {
            Shading::Lit | Shading::IrradianceOnly => self.tone_map,
            Shading::FalseColour | Shading::Albedo | Shading::Normals => ToneMap::Linear,
        }
    }
}
