//! Options of `hemicube render` about shadows.

use anyhow::Result;
use clap::{Args, ValueEnum};

use crate::cli::value::radius;
use crate::render::shadow::{DebugView, ShadowDebug};
use crate::render::{ShadowSettings, ShadowTechnique};

/// Which shadows direct light throws.
#[derive(Args, Clone, Debug)]
pub struct ShadowOptions {
    /// Draws direct light from the lights themselves, with these shadows, on top of the indirect light of the bake (or
    /// of ambient light, or of none with --lighting direct, which then need no bake).
    #[arg(long, value_enum, value_name = "TECHNIQUE")]
    pub shadows: Option<TechniqueName>,
    /// Points on each lamp that has a size from which light comes, 1 to 256; many make soft shadows.
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u32).range(1..=256))]
    pub light_samples: u32,
    /// Size that point and spot lights are given, metres; with many --light-samples their shadows become soft.
    #[arg(long, value_name = "M", default_value = "0", value_parser = radius)]
    pub light_radius: f32,
    /// Draws over the picture what the shadows of one light work with.
    #[arg(long, value_enum, value_name = "VIEW", conflicts_with_all = ["compare_shadows", "reference"])]
    pub shadow_debug: Option<DebugName>,
    /// Which light sample --shadow-debug shows, from 0.
    #[arg(long, value_name = "N", default_value = "0", requires = "shadow_debug")]
    pub shadow_debug_light: usize,
    /// Draws no light but where technique A finds other shadows than technique B, and prints how many pixels these are,
    /// more than one pixel away from an edge of a shadow (of B, or of the ray-traced one).
    #[arg(long, value_name = "A,B", value_enum, value_delimiter = ',', num_args = 1, conflicts_with_all = ["shadows", "reference"])]
    pub compare_shadows: Option<Vec<TechniqueName>>,
}

/// Techniques as written on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TechniqueName {
    /// Light passes through everything.
    None,
    /// Depth seen from the light.
    Map,
    /// Stencil volumes counted in front of what is seen.
    VolumeDepthPass,
    /// Stencil volumes counted behind what is seen.
    VolumeDepthFail,
    /// Casters flattened on to the largest planes.
    Planar,
    /// One ray a pixel: the truth.
    Raytraced,
}

/// Debug views as written on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum DebugName {
    /// In how many shadow volumes, or under how many planar shadows, each point is.
    StencilCounts,
    /// Sides of the shadow volumes as translucent hulls.
    Volumes,
    /// Edges at which the light sees casters end.
    Silhouettes,
    /// Depth in the faces of the shadow map: near is bright, nothing is blue.
    Map,
    /// Planes that receive planar shadows, outlined.
    Receivers,
}

impl DebugName {
    fn view(self) -> DebugView {
        match self {
            DebugName::StencilCounts => DebugView::StencilCounts,
            DebugName::Volumes => DebugView::Volumes,
            DebugName::Silhouettes => DebugView::Silhouettes,
            DebugName::Map => DebugView::Map,
            DebugName::Receivers => DebugView::Receivers,
        }
    }
}

impl TechniqueName {
    fn technique(self) -> ShadowTechnique {
        match self {
            TechniqueName::None => ShadowTechnique::None,
            TechniqueName::Map => ShadowTechnique::Map,
            TechniqueName::VolumeDepthPass => ShadowTechnique::VolumeDepthPass,
            TechniqueName::VolumeDepthFail => ShadowTechnique::VolumeDepthFail,
            TechniqueName::Planar => ShadowTechnique::Planar,
            TechniqueName::Raytraced => ShadowTechnique::Raytraced,
        }
    }
}

impl ShadowOptions {
    /// Settings of the shadows that are to be drawn.
    #[must_use]
    pub fn settings(&self) -> Option<ShadowSettings> {
        self.shadows.map(|name| self.settings_of(name))
    }

    /// The debug view that is to be drawn.
    #[must_use]
    pub fn debug(&self) -> Option<ShadowDebug> {
        self.shadow_debug.map(|name| ShadowDebug { view: name.view(), light: self.shadow_debug_light })
    }

    /// The two techniques that are to be compared.
    ///
    /// # Errors
    /// There are not two.
    pub fn compared(&self) -> Result<Option<[ShadowSettings; 2]>> {
        match self.compare_shadows.as_deref() {
            None => Ok(None),
            Some(&[a, b]) => Ok(Some([self.settings_of(a), self.settings_of(b)])),
            Some(_) => anyhow::bail!("--compare-shadows takes two techniques, as in map,raytraced"),
        }
    }

    fn settings_of(&self, name: TechniqueName) -> ShadowSettings {
        let (light_samples, light_radius) = (self.light_samples, self.light_radius);
        ShadowSettings { light_samples, light_radius, ..ShadowSettings::new(name.technique()) }
    }
}
