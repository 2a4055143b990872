//! Options of `hemicube render` about shadows.

use anyhow::Result;
use clap::{Args, ValueEnum};

use crate::cli::value::radius;
use crate::render::shadow::{DebugView, ShadowDebug};
use crate::render::{ShadowSettings, ShadowTechnique};

/// Shadows of direct light.
#[derive(Args, Clone, Debug)]
pub struct ShadowOptions {
    /// Adds direct light in real time, with shadows by this technique, to the indirect light of the bake; with
    /// --lighting ambient or direct no bake is needed.
    #[arg(long, value_enum, value_name = "TECHNIQUE")]
    pub shadows: Option<TechniqueName>,
    /// Number of light samples on each lamp that has a size, 1 to 256; many make soft shadows.
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u32).range(1..=256))]
    pub light_samples: u32,
    /// Radius of point and spot lights, metres; with many --light-samples their shadows become soft.
    #[arg(long, value_name = "M", default_value = "0", value_parser = radius)]
    pub light_radius: f32,
    /// Draws a debug view of the shadows of one light sample over the picture.
    #[arg(long, value_enum, value_name = "VIEW", conflicts_with_all = ["compare_shadows", "reference"])]
    pub shadow_debug: Option<DebugName>,
    /// Index of the light sample that --shadow-debug shows.
    #[arg(long, value_name = "N", default_value = "0", requires = "shadow_debug")]
    pub shadow_debug_light: usize,
    /// Draws where the shadows of techniques A and B differ, and prints the share of these pixels; pixels next to a
    /// shadow edge (of the ray-traced technique, else of B) do not count.
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
    /// Settings of the shadows; `None` without --shadows.
    #[must_use]
    pub fn settings(&self) -> Option<ShadowSettings> {
        self.shadows.map(|name| self.settings_of(name))
    }

    /// The debug view, if one is wanted.
    #[must_use]
    pub fn debug(&self) -> Option<ShadowDebug> {
        self.shadow_debug.map(|name| ShadowDebug { view: name.view(), light: self.shadow_debug_light })
    }

    /// Settings of the two techniques to compare; `None` without --compare-shadows.
    ///
    /// # Errors
    /// Returns an error if there are not two techniques.
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
