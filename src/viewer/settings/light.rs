//! Settings of how the light of the scene is shown, and the render settings that follow from them.

use glam::Vec3;

use crate::render::shadow::{DebugView, ShadowDebug};
use crate::render::{Exposure, LuxScale, RenderSettings, Shading, ShadowSettings, ShadowTechnique, ToneMap};
use crate::scene::Scene;
use crate::viewer::settings::comparison::{ComparedShadows, ComparisonLayout};

/// Change of the exposure by one key press, stops.
const EV_STEP: f32 = 1.0 / 3.0;
/// Radiance of white surfaces in ambient light, before any light is computed.
const WORK_LIGHT: Vec3 = Vec3::splat(1.0);

/// Shadings with their names and hints, in the order of [`LightSettings::next_shading`].
pub const SHADINGS: [(Shading, &str, &str); 5] = [
    (Shading::Lit, "Lit", "Light that the surfaces send"),
    (Shading::IrradianceOnly, "Light only", "Light that arrives, as white paint would show it"),
    (Shading::FalseColour, "Illuminance", "Lux in false colours, with lines of equal lux"),
    (Shading::Albedo, "Reflectance", "Colours without light"),
    (Shading::Normals, "Normals", "Directions of the surfaces"),
];

/// How the light of the scene is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct LightSettings {
    /// True if the exposure is metered from the picture.
    pub is_auto: bool,
    /// Exposure if it is not metered, stops.
    pub ev: f32,
    /// Mapping of radiance to display colours.
    pub tone_map: ToneMap,
    /// Quantity that is shown on the surfaces.
    pub shading: Shading,
    /// Illuminance of each false colour.
    pub lux_scale: LuxScale,
    /// True if direct light is shown.
    pub direct: bool,
    /// True if indirect light (after at least one reflection) is shown.
    pub indirect: bool,
    /// True if backs of single-sided surfaces are culled. Rooms can then be seen from outside.
    pub see_through_backs: bool,
    /// True if direct light is real-time light: computed from the lamps in each picture, with `shadows`, instead of
    /// read from the bake.
    pub is_real_time: bool,
    /// Shadow technique and its settings.
    pub shadows: ShadowSettings,
    /// Technique that `shadows` are compared with, without its faults; `None` if nothing is compared.
    pub compared_technique: Option<ShadowTechnique>,
    /// Layout of the comparison.
    pub comparison_layout: ComparisonLayout,
    /// Position of the divider of a split picture, as a fraction of its width.
    pub divider: f32,
    /// The debug view of the shadows, if one is shown.
    pub debug: Option<DebugView>,
    /// The light sample that the debug view shows.
    pub debug_light: usize,
    /// Intensity and colour of each light group `[g]`.
    pub groups: Vec<GroupDial>,
}

/// Intensity and colour of one light group.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupDial {
    /// Name of the group.
    pub name: String,
    /// Factor on the baked light.
    pub intensity: f32,
    /// Colour factor, linear; white leaves the light as baked.
    pub tint: Vec3,
    /// True if the group is switched on.
    pub is_on: bool,
}

impl Default for LightSettings {
    fn default() -> Self {
        let render_settings = RenderSettings::default();
        Self {
            is_auto: true,
            ev: 0.0,
            tone_map: render_settings.tone_map,
            shading: render_settings.shading,
            lux_scale: render_settings.lux_scale,
            direct: true,
            indirect: true,
            see_through_backs: render_settings.cull_back,
            is_real_time: false,
            shadows: ShadowSettings::new(ShadowTechnique::VolumeDepthFail),
            compared_technique: None,
            comparison_layout: ComparisonLayout::default(),
            divider: 0.5,
            debug: None,
            debug_light: 0,
            groups: Vec::new(),
        }
    }
}

impl LightSettings {
    /// Creates a dial for each light group of the scene, all as baked.
    pub fn reset_groups(&mut self, scene: &Scene) {
        self.groups = scene.light_groups.iter().map(|name| GroupDial::of(name)).collect();
    }

    /// Fixes the exposure at the metered value.
    pub fn fix_exposure(&mut self, metered_ev: Option<f32>) {
        if std::mem::take(&mut self.is_auto) {
            self.ev = metered_ev.unwrap_or(self.ev);
        }
    }

    /// Raises the exposure by `steps` thirds of a stop.
    pub fn step_exposure(&mut self, steps: f32) {
        self.ev += steps * EV_STEP;
    }

    /// Switches to the next of [`SHADINGS`].
    pub fn next_shading(&mut self) {
        let at = SHADINGS.iter().position(|(shading, ..)| *shading == self.shading).unwrap_or(0);
        self.shading = SHADINGS[(at + 1) % SHADINGS.len()].0;
    }

    /// Switches to the other tone map.
    pub fn next_tone_map(&mut self) {
        self.tone_map = match self.tone_map {
            ToneMap::Neutral => ToneMap::Linear,
            ToneMap::Linear => ToneMap::Neutral,
        };
    }

    /// Returns the second shadows of the comparison: the same light samples with another technique.
    #[must_use]
    pub fn compared_shadows(&self) -> Option<ComparedShadows> {
        let technique = self.compared_technique.filter(|_| self.is_real_time)?;
        let ShadowSettings { light_samples, light_radius, .. } = self.shadows;
        let settings = ShadowSettings { light_samples, light_radius, ..ShadowSettings::new(technique) };
        Some(ComparedShadows { settings, layout: self.comparison_layout })
    }

    /// Returns true if two techniques are shown, one on each side of a divider.
    #[must_use]
    pub fn is_split(&self) -> bool {
        self.is_real_time && self.compared_technique.is_some() && self.comparison_layout == ComparisonLayout::Split
    }

    /// Returns the render settings of the picture. A scene without light is shown in uniform ambient light.
    #[must_use]
    pub fn render_settings(&self, is_lit: bool) -> RenderSettings {
        RenderSettings {
            exposure: if self.is_auto { Exposure::Auto } else { Exposure::Ev(self.ev) },
            tone_map: self.tone_map,
            shading: self.shading,
            lux_scale: self.lux_scale.in_order(),
            direct: f32::from(self.direct),
            indirect: f32::from(self.indirect),
            shadows: self.is_real_time.then(|| self.shadows.clone()),
            shadow_debug: self
                .debug
                .filter(|_| self.is_real_time)
                .map(|view| ShadowDebug { view, light: self.debug_light }),
            ambient: if is_lit { Vec3::ZERO } else { WORK_LIGHT },
            group_weights: self.groups.iter().map(GroupDial::weight).collect(),
            cull_back: self.see_through_backs,
            ..RenderSettings::default()
        }
    }
}

impl GroupDial {
    /// Creates the dial of the group `name`, as baked.
    #[must_use]
    pub fn of(name: &str) -> Self {
        Self { name: name.to_owned(), intensity: 1.0, tint: Vec3::ONE, is_on: true }
    }

    /// Returns the factor on the baked light, per channel.
    #[must_use]
    pub fn weight(&self) -> Vec3 {
        if self.is_on { self.tint * self.intensity } else { Vec3::ZERO }
    }

    /// Returns true if the light is as baked.
    #[must_use]
    pub fn is_as_baked(&self) -> bool {
        self.weight() == Vec3::ONE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_that_are_off_have_no_weight_and_keep_their_dials() {
        let scene = Scene { light_groups: vec!["lamps".into(), "sky".into()], ..Scene::default() };
        let mut settings = LightSettings::default();
        settings.reset_groups(&scene);
        settings.groups[0].intensity = 0.5;
        settings.groups[0].tint = Vec3::new(1.0, 0.5, 0.0);
        settings.groups[1].is_on = false;
        assert_eq!(settings.render_settings(true).group_weights, [Vec3::new(0.5, 0.25, 0.0), Vec3::ZERO]);
        assert!(!settings.groups[0].is_as_baked() && GroupDial::of("lamps").is_as_baked());
        assert_eq!(settings.groups[1].intensity, 1.0);
    }

    #[test]
    fn an_unlit_scene_is_not_black() {
        let settings = LightSettings::default();
        assert!(settings.render_settings(false).ambient.min_element() > 0.0);
        assert_eq!(settings.render_settings(true).ambient, Vec3::ZERO);
    }

    #[test]
    fn fixed_exposure_begins_with_the_metered_one() {
        let mut settings = LightSettings::default();
        settings.fix_exposure(Some(-4.0));
        settings.step_exposure(3.0);
        assert!(matches!(settings.render_settings(true).exposure, Exposure::Ev(ev) if (ev + 3.0).abs() < 1e-6));
        settings.fix_exposure(Some(7.0));
        assert!(matches!(settings.render_settings(true).exposure, Exposure::Ev(ev) if (ev + 3.0).abs() < 1e-6));
    }
}
