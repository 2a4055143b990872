//! `hemicube measure`: reads a table of points and writes a table of the irradiance at them.

mod table;

use std::path::PathBuf;

use anyhow::{Context, Result, bail};
use clap::{Args, ValueEnum};

use super::bake_options::BakeOptions;
use super::lit_scene::{bake_device, bake_watched};
use super::scene_input::{VariantOption, load};
use super::terminal::Terminal;
use crate::bake::{MeasureContext, MeasureSettings, Measured, look_up, measure_with};
use crate::baked::{self, BakedScene};
use crate::base::output::write_whole;
use crate::patch::{MeshSettings, PatchMesh};
use crate::raytrace::{self, MeasuringPoint, PathSettings};
use crate::scene::Scene;
use crate::trace::Tracer;

use table::{read_points, table_of_estimates, table_of_values};

/// Options of `hemicube measure`.
#[derive(Args, Debug)]
pub struct MeasureArgs {
    /// Scene to measure in: .glb or .gltf, baked or not (FILE#NAME chooses one of its scenes), or builtin:gallery,
    /// builtin:cornell or builtin:mirrors.
    pub scene: PathBuf,
    /// Material variant of the file.
    #[command(flatten)]
    pub variant: VariantOption,
    /// Table of points: a header, then px,py,pz,nx,ny,nz a line (position in metres, normal); further columns are
    /// ignored.
    #[arg(long, value_name = "P.csv")]
    pub points: PathBuf,
    /// Table of irradiance (lux), in the same order: px,py,pz,nx,ny,nz,E_r,E_g,E_b,Ed_r,Ed_g,Ed_b,lux (Ed: direct
    /// part).
    #[arg(short, long, value_name = "E.csv")]
    pub output: PathBuf,
    /// Interpolates the light stored at the vertices round each point, as the viewer shows it.
    #[arg(long, conflicts_with = "renderer")]
    pub from_bake: bool,
    /// How irradiance is computed; path adds the columns se_r,se_g,se_b (standard error).
    #[arg(long, value_enum, value_name = "RENDERER", default_value = "radiosity")]
    pub renderer: Renderer,
    /// With path: paths a point, rounded up to a multiple of 32.
    #[arg(long, value_name = "N", default_value = "4096", value_parser = clap::value_parser!(u32).range(16..=1 << 24))]
    pub spp: u32,
    /// With path: the largest number of reflections that a path follows [default: unlimited].
    #[arg(long, value_name = "K")]
    pub max_bounces: Option<u32>,
    /// How to bake a file that stores no light.
    #[command(flatten)]
    pub bake: BakeOptions,
}

/// How irradiance is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Renderer {
    /// Direct light, and a final gather over a bake.
    Radiosity,
    /// Path tracing: the reference.
    Path,
}

/// A scene and its light.
struct LitScene {
    /// The scene before the bake; `None` if the file stores only the bake.
    original: Option<Scene>,
    mesh: PatchMesh,
    baked: BakedScene,
}

/// Measures and writes the table.
///
/// # Errors
/// Returns an error if the scene or the points cannot be read, the scene cannot be baked, the user stops it, or the
/// table cannot be written.
pub fn run(args: &MeasureArgs, terminal: Terminal) -> Result<()> {
    let points = read_points(&args.points)?;
    let scene = load(&args.scene, &args.variant)?;
    let table = match args.renderer {
        Renderer::Path => by_paths(&scene, &points, args, terminal)?,
        Renderer::Radiosity => by_radiosity(scene, &points, args, terminal)?,
    };
    write_whole(&args.output, table.as_bytes()).with_context(|| format!("{}: cannot be written", args.output.display()))
}

/// Computes irradiance from the light of the file, or of a bake made now.
fn by_radiosity(scene: Scene, points: &[MeasuringPoint], args: &MeasureArgs, terminal: Terminal) -> Result<String> {
    let settings = args.bake.settings();
    let lit = match baked::gltf::from_scene(scene) {
        Ok(baked) => {
            let mesh = PatchMesh::new(&baked.scene, &MeshSettings::uncut())?;
            LitScene { original: None, mesh, baked }
        }
        Err(scene) => {
            let device = bake_device(&settings)?;
            let bake = bake_watched(device.as_ref(), &scene, &settings, None, terminal)?;
            if bake.report.work.cancelled {
                bail!("stopped");
            }
            LitScene { original: Some(scene), mesh: bake.mesh, baked: bake.baked }
        }
    };
    if args.from_bake {
        return table_of_values(points, &look_up(&lit.baked, points));
    }
    let watch = terminal.watch()?;
    let scene = lit.original.as_ref().unwrap_or(&lit.baked.scene);
    let context = MeasureContext { scene, mesh: &lit.mesh, baked: &lit.baked, progress: &watch };
    let measured = measure_with(&context, points, &MeasureSettings::preset(settings.quality));
    watch.finish();
    let measured: Vec<Option<Measured>> = measured.context("stopped")?.into_iter().map(Some).collect();
    table_of_values(points, &measured)
}

/// Computes irradiance by path tracing.
fn by_paths(scene: &Scene, points: &[MeasuringPoint], args: &MeasureArgs, terminal: Terminal) -> Result<String> {
    let default = PathSettings::default();
    let settings = PathSettings {
        samples: args.spp,
        max_bounces: args.max_bounces.unwrap_or(default.max_bounces),
        has_specular: false,
        ..default
    };
    let watch = terminal.watch()?;
    let estimates = raytrace::irradiance(&Tracer::new(scene), points, &settings, &watch);
    watch.finish();
    table_of_estimates(points, &estimates.context("stopped")?)
}
