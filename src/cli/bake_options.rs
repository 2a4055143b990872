//! Options of every subcommand that may bake.

use clap::Args;

use super::value::{hemicube_size, one_of, positive, share};
use crate::bake::{BakeSettings, Method, Quality, Refinement, Solver};

/// How to bake.
#[derive(Args, Clone, Debug)]
pub struct BakeOptions {
    /// Preset of all settings that are not given.
    #[arg(long, default_value = "medium", value_parser = one_of(Quality::ALL.map(|q| (q, q.name(), q.hint()))))]
    pub quality: Quality,
    /// Longest edge of an element, metres [default: from the area of the scene and the preset].
    #[arg(long, value_name = "M", value_parser = positive)]
    pub element_size: Option<f32>,
    /// Halves elements in which light deviates by more than this share from interpolation between their corners; 0
    /// halves none [default: 0.1, 0.04 or 0.02 by preset].
    #[arg(long, value_name = "SHARE", value_parser = share)]
    pub refine: Option<f32>,
    /// Width of the hemicubes at the vertices, pixels: a power of two from 16 to 512 [default: 32, 64 or 128 by
    /// preset].
    #[arg(long, value_name = "PX", value_parser = hemicube_size)]
    pub hemicube_size: Option<u32>,
    /// How form factors are computed [default: the faster one on this machine]. All methods give the same light.
    #[arg(long, value_name = "METHOD", value_parser = one_of(Method::ALL.map(|m| (m, m.name(), m.hint()))))]
    pub method: Option<Method>,
    /// How the radiosity equation is solved. All solvers give the same light.
    #[arg(long, value_name = "SOLVER", default_value = "progressive", value_parser = one_of(Solver::ALL.map(|s| (s, s.name(), s.hint()))))]
    pub solver: Solver,
    /// With gathering: ends after N passes; 0 shows the lamps, 1 direct light, 2 the first reflection [default: when
    /// the light converges]. With progressive: ends after N shots a patch on average [default: 64].
    #[arg(long, value_name = "N")]
    pub passes: Option<u32>,
}

impl BakeOptions {
    /// Returns the bake settings that the options describe.
    #[must_use]
    pub fn settings(&self) -> BakeSettings {
        let preset = BakeSettings::preset(self.quality);
        BakeSettings {
            element_size: self.element_size,
            refinement: Refinement {
                max_error: self.refine.unwrap_or(preset.refinement.max_error),
                ..preset.refinement
            },
            hemicube_px: self.hemicube_size.unwrap_or(preset.hemicube_px),
            method: self.method,
            solver: self.solver,
            passes: self.passes.map(|passes| passes as usize),
            ..preset
        }
    }
}
