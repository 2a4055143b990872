//! Options of `hemicube render` about shadows.

use anyhow::Result;
use clap::Args;

use crate::cli::value::{one_of, radius};
use crate::render::shadow::{DebugView, ShadowDebug};
use crate::render::{ShadowSettings, ShadowTechnique};

/// Shadows of direct light.
#[derive(Args, Clone, Debug)]
pub struct ShadowOptions {
    /// Adds direct light in real time, with shadows by this technique, to the indirect light of the bake; with
    /// --lighting ambient or direct no bake is needed.
    #[arg(long, value_name = "TECHNIQUE", value_parser = one_of(techniques()))]
    pub shadows: Option<ShadowTechnique>,
    /// Number of light samples on each lamp that has a size, 1 to 256; many make soft shadows.
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u32).range(1..=256))]
    pub light_samples: u32,
    /// Radius of point and spot lights, metres; with many --light-samples their shadows become soft.
    #[arg(long, value_name = "M", default_value = "0", value_parser = radius)]
    pub light_radius: f32,
    /// Draws a debug view of the shadows of one light sample over the picture.
    #[arg(long, value_name = "VIEW", conflicts_with_all = ["compare_shadows", "reference"],
          value_parser = one_of(DebugView::ALL.map(|info| (info.view, info.name, info.hint))))]
    pub shadow_debug: Option<DebugView>,
    /// Index of the light sample that --shadow-debug shows.
    #[arg(long, value_name = "N", default_value = "0", requires = "shadow_debug")]
    pub shadow_debug_light: usize,
    /// Draws where the shadows of techniques A and B differ, and prints the share of these pixels; pixels next to a
    /// shadow edge (of the ray-traced technique, else of B) do not count.
    #[arg(long, value_name = "A,B", value_delimiter = ',', num_args = 1, conflicts_with_all = ["shadows", "reference"],
          value_parser = one_of(techniques()))]
    pub compare_shadows: Option<Vec<ShadowTechnique>>,
}

/// Returns the table of techniques for [`one_of`].
fn techniques() -> [(ShadowTechnique, &'static str, &'static str); ShadowTechnique::ALL.len()] {
    ShadowTechnique::ALL.map(|info| (info.technique, info.name, info.hint))
}

impl ShadowOptions {
    /// Returns the settings of the shadows; `None` without --shadows.
    #[must_use]
    pub fn settings(&self) -> Option<ShadowSettings> {
        self.shadows.map(|technique| self.settings_of(technique))
    }

    /// Returns the debug view; `None` without --shadow-debug.
    #[must_use]
    pub fn debug(&self) -> Option<ShadowDebug> {
        self.shadow_debug.map(|view| ShadowDebug { view, light: self.shadow_debug_light })
    }

    /// Returns the settings of the two techniques to compare; `None` without --compare-shadows.
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

    fn settings_of(&self, technique: ShadowTechnique) -> ShadowSettings {
        let (light_samples, light_radius) = (self.light_samples, self.light_radius);
        ShadowSettings { light_samples, light_radius, ..ShadowSettings::new(technique) }
    }
}
