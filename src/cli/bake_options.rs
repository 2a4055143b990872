//! Options of every subcommand that may have to bake, and the way from a file to a lit scene.

use std::path::Path;

use anyhow::{Context, Result};
use clap::{Args, ValueEnum};

use crate::bake::{Bake, BakeSettings, Method, Quality, Solver, bake_with_rows};
use crate::baked::{self, BakedScene};
use crate::form_factor::row_cache::RowCache;
use crate::gpu::Gpu;
use crate::scene::gltf::LoadOptions;
use crate::scene::{Scene, builtin, gltf};

use super::terminal::TerminalWatch;

/// How to bake.
#[derive(Args, Clone, Debug)]
pub struct BakeOptions {
    /// Preset: draft is a first look, medium for walking through, high for measuring.
    #[arg(long, value_enum, default_value = "medium")]
    pub quality: QualityName,
    /// Longest element edge in metres [default: chosen from the scene's area and the preset].
    #[arg(long, value_name = "M", value_parser = positive)]
    pub element_size: Option<f32>,
    /// Elements are halved where light deviates by this share from what lies between their corners; 0 leaves them of one size
    /// [default: 0.1, 0.04 or 0.02 by preset].
    #[arg(long, value_name = "SHARE", value_parser = share)]
    pub refine: Option<f32>,
    /// Width of the gathering hemicubes in pixels, a power of two from 16 to 512 [default: 32, 64 or 128 by preset].
    #[arg(long, value_name = "PX", value_parser = hemicube_size)]
    pub hemicube_size: Option<u32>,
    /// How form factors are found: hemicubes need a GPU or its software driver, hemispheres (rays) need none [default: the
    /// faster one here].
    #[arg(long, value_enum, value_name = "METHOD")]
    pub method: Option<MethodName>,
    /// How the system is solved: by shooting, by gathering pass after pass, or as a full matrix (small scenes); all lead to
    /// one answer.
    #[arg(long, value_enum, value_name = "SOLVER", default_value = "progressive")]
    pub solver: SolverName,
    /// Gathering ends with the light of N reflections, 0 showing the lamps and 1 direct light alone [default: when nothing
    /// changes];
    /// progressive refinement ends after N shots a patch on average [default: 64].
    #[arg(long, value_name = "N")]
    pub passes: Option<u32>,
}

/// Which of a file's material variants is meant.
#[derive(Args, Clone, Debug)]
pub struct VariantOption {
    /// Material variant of the file, by name (KHR_materials_variants; `hemicube info` lists them) [default: none].
    #[arg(long, value_name = "NAME")]
    pub variant: Option<String>,
}

/// Presets as written on the command line.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum QualityName {
    /// A first look.
    Draft,
    /// For walking through.
    Medium,
    /// For measuring.
    High,
}

/// Methods as written on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MethodName {
    /// Item buffers drawn by the GPU.
    Hemicube,
    /// Rays on the CPU.
    Hemisphere,
}

/// Solvers as written on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SolverName {
    /// Shooting, the greatest unshot power first.
    Progressive,
    /// Gathering pass after pass.
    Gathering,
    /// The full matrix.
    Matrix,
}

impl BakeOptions {
    /// The settings that the options mean.
    #[must_use]
    pub fn settings(&self) -> BakeSettings {
        let preset = BakeSettings::preset(match self.quality {
            QualityName::Draft => Quality::Draft,
            QualityName::Medium => Quality::Medium,
            QualityName::High => Quality::High,
        });
        BakeSettings {
            element_size: self.element_size,
            refine_error: self.refine.unwrap_or(preset.refine_error),
            hemicube_px: self.hemicube_size.unwrap_or(preset.hemicube_px),
            method: self.method.map(|method| match method {
                MethodName::Hemicube => Method::Hemicube,
                MethodName::Hemisphere => Method::Hemisphere,
            }),
            solver: match self.solver {
                SolverName::Progressive => Solver::Progressive,
                SolverName::Gathering => Solver::Gathering,
                SolverName::Matrix => Solver::Matrix,
            },
            passes: self.passes.map(|passes| passes as usize),
            ..preset
        }
    }
}

/// Parses a number above zero.
pub fn positive(text: &str) -> Result<f32, String> {
    match text.parse() {
        Ok(value) if value > 0.0 && f32::is_finite(value) => Ok(value),
        _ => Err("must be a positive number".to_owned()),
    }
}

/// Parses a number from zero to one.
pub fn share(text: &str) -> Result<f32, String> {
    match text.parse() {
        Ok(value) if (0.0..=1.0).contains(&value) => Ok(value),
        _ => Err("must be a number from 0 to 1".to_owned()),
    }
}

/// Parses the width of a hemicube.
pub fn hemicube_size(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(size @ (16 | 32 | 64 | 128 | 256 | 512)) => Ok(size),
        _ => Err("must be 16, 32, 64, 128, 256 or 512".to_owned()),
    }
}

/// Loads a scene: a file, or a built-in one, `builtin:NAME`.
///
/// # Errors
/// The file cannot be loaded or has no such variant, or there is no such built-in scene.
pub fn load(path: &Path, wanted: &VariantOption) -> Result<Scene> {
    match path.to_str().and_then(|text| text.strip_prefix(builtin::PREFIX)) {
        Some(name) => builtin::by_name(name)
            .with_context(|| format!("there is no built-in scene {name}; there are {}", builtin::NAMES.join(", "))),
        None => Ok(gltf::load_with(path, &LoadOptions { variant: wanted.variant.clone() })?),
    }
}

/// The device that a bake shall draw hemicubes with; none where there is none and the bake can do without.
///
/// # Errors
/// Hemicubes were asked for and no driver answers.
pub fn bake_device(settings: &BakeSettings) -> Result<Option<Gpu>> {
    if settings.method == Some(Method::Hemisphere) {
        return Ok(None);
    }
    match Gpu::headless() {
        Ok(gpu) => Ok(Some(gpu)),
        Err(error) if settings.method.is_none() => {
            log::warn!("{error}; form factors come from rays instead");
            Ok(None)
        }
        Err(error) => Err(error.into()),
    }
}

/// Bakes with progress on the terminal; Ctrl-C ends it after the current batch and keeps what is solved.
///
/// # Errors
/// The scene cannot be baked.
pub fn bake_watched(
    gpu: Option<&Gpu>,
    scene: &Scene,
    settings: &BakeSettings,
    rows: Option<&RowCache>,
    is_quiet: bool,
) -> Result<Bake> {
    let watch = TerminalWatch::interruptible(is_quiet)?;
    let finished = bake_with_rows(gpu, scene, settings, rows, &watch)?;
    watch.finish();
    for note in &scene.notes {
        log::info!("{note}");
    }
    Ok(finished)
}

/// A loaded scene with its light: stored in the file, or baked now.
///
/// # Errors
/// The scene cannot be baked.
pub fn lit_scene(gpu: Option<&Gpu>, scene: Scene, settings: &BakeSettings, is_quiet: bool) -> Result<BakedScene> {
    match baked::gltf::from_scene(scene) {
        Ok(baked) => Ok(baked),
        Err(scene) => Ok(bake_watched(gpu, &scene, settings, None, is_quiet)?.baked),
    }
}
