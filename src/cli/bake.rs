//! `hemicube bake`: solves the light of a scene and writes it as a standard .glb.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::Args;

use super::bake_options::BakeOptions;
use super::lightmap_export::{LightmapOptions, write_lightmap};
use super::lit_scene::{bake_device, bake_watched};
use super::scene_input::{VariantOption, load};
use super::terminal::Terminal;
use super::value::{exposure, positive};
use crate::bake::{BakeSettings, MeshCounts, Report, Work};
use crate::baked;
use crate::base::output::write_whole;
use crate::form_factor::row_cache::RowCache;
use crate::render::Exposure;

/// Largest size of a row cache, bytes.
const ROW_CACHE_BYTES: u64 = 1 << 30;

/// Options of `hemicube bake`.
#[derive(Args, Debug)]
pub struct BakeArgs {
    /// Scene to bake: .glb or .gltf (FILE#NAME chooses one of its scenes), or builtin:gallery,
    /// builtin:cornell or builtin:mirrors.
    #[arg(default_value = "builtin:gallery")]
    pub scene: PathBuf,
    /// Material variant of the file.
    #[command(flatten)]
    pub variant: VariantOption,
    /// The baked scene, a .glb.
    #[arg(short, long, value_name = "OUT.glb")]
    pub output: PathBuf,
    /// Exposure in stops for programs that cannot read the stored light: displayed = radiance x 2^EV; auto suits the
    /// whole scene and is printed.
    #[arg(long, value_name = "EV|auto", default_value = "auto", value_parser = exposure, allow_negative_numbers = true)]
    pub exposure: Exposure,
    /// How to bake.
    #[command(flatten)]
    pub bake: BakeOptions,
    /// Options of the lightmap.
    #[command(flatten)]
    pub lightmap: LightmapOptions,
    /// Ends the solver when this share of the reflected direct light is unshot [default: 0.01, 0.001 or 0.0003 by
    /// preset].
    #[arg(long, value_name = "X", value_parser = positive)]
    pub threshold: Option<f32>,
    /// Keeps form factors in this file, up to 1 GiB: a stopped bake continues from there, and a bake of the same
    /// geometry with other colours or lamps is faster.
    #[arg(long, value_name = "FILE")]
    pub row_cache: Option<PathBuf>,
    /// Writes the certificate of the bake: counts, energy balance, times (s).
    #[arg(long, value_name = "R.json")]
    pub report: Option<PathBuf>,
}

/// Bakes the scene and writes it.
///
/// # Errors
/// Returns an error if the scene cannot be loaded or baked, or a file cannot be written.
pub fn run(args: &BakeArgs, terminal: Terminal) -> Result<()> {
    if args.output.extension().is_none_or(|extension| !extension.eq_ignore_ascii_case("glb")) {
        bail!("{}: a bake is written as .glb", args.output.display());
    }
    let scene = load(&args.scene, &args.variant)?;
    let preset = args.bake.settings();
    let settings = BakeSettings { threshold: args.threshold.unwrap_or(preset.threshold), ..preset };
    let gpu = bake_device(&settings)?;
    let rows = args.row_cache.as_deref().map(|path| RowCache::open(path, ROW_CACHE_BYTES)).transpose()?;
    let bake = bake_watched(gpu.as_ref(), &scene, &settings, rows.as_ref(), terminal)?;
    let exposure_ev = match args.exposure {
        Exposure::Ev(ev) => ev,
        Exposure::Auto => baked::exposure::suited(&bake.baked),
    };
    baked::gltf::write(&args.output, &bake.baked, exposure_ev)?;
    let map = args.lightmap.lightmap_of(&bake, &scene, &settings);
    if let Some(map) = map.with_context(|| format!("{}: no lightmap", args.output.display()))? {
        terminal.print(write_lightmap(&map, &args.output, exposure_ev)?);
    }
    if let Some(path) = &args.report {
        write_report(path, &bake.report)?;
    }
    print_summary(&bake.report, &args.output, exposure_ev, terminal);
    if let Some(rows) = &rows {
        terminal.print(format_args!(
            "{} of the hemicubes were in the row cache, which has {} now",
            rows.num_reused(),
            rows.len()
        ));
    }
    if bake.report.work.cancelled {
        eprintln!("stopped early: what was solved until then is in the file");
    }
    Ok(())
}

/// Prints the size and the duration of the bake.
fn print_summary(report: &Report, output: &Path, exposure_ev: f32, terminal: Terminal) {
    let Report {
        mesh: MeshCounts { elements, patches, .. }, work: Work { hemicubes, unshot_share, .. }, seconds, ..
    } = report;
    terminal.print(format_args!(
        "{}: {elements} elements, {patches} patches, {hemicubes} hemicubes, {:.2} % unshot, {:.1} s; other programs show it at \
         --exposure {exposure_ev:.2}",
        output.display(),
        100.0 * unshot_share,
        seconds.total
    ));
}

/// Writes the report as JSON.
fn write_report(path: &Path, report: &Report) -> Result<()> {
    let mut text = serde_json::to_string_pretty(report)?;
    text.push('\n');
    write_whole(path, text.as_bytes()).with_context(|| format!("{}: cannot be written", path.display()))
}
