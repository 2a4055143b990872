//! `hemicube measure`: irradiance at given points, from a table to a table.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::{Args, ValueEnum};
use glam::Vec3;

use super::bake_options::{BakeOptions, VariantOption, bake_device, bake_watched, load};
use super::terminal::TerminalWatch;
use crate::bake::measure::{MeasureSettings, Measured, look_up, measure};
use crate::baked::{self, BakedScene};
use crate::base::colour::luminance;
use crate::base::output::write_whole;
use crate::patch::{MeshSettings, PatchMesh};
use crate::raytrace::{self, Irradiance, MeasuringPoint, PathSettings};
use crate::scene::Scene;
use crate::trace::Tracer;

/// Options of `hemicube measure`.
#[derive(Args, Debug)]
pub struct MeasureArgs {
    /// Scene to measure in: .glb or .gltf, baked or not (FILE#NAME chooses one of its scenes), or builtin:gallery,
    /// builtin:cornell or builtin:mirrors.
    pub scene: PathBuf,
    /// Which materials it wears.
    #[command(flatten)]
    pub variant: VariantOption,
    /// Table of points: a header, then px,py,pz,nx,ny,nz a line (metres, normal); further columns are ignored.
    #[arg(long, value_name = "P.csv")]
    pub points: PathBuf,
    /// Table of irradiance, in the same order: px,py,pz,nx,ny,nz,E_r,E_g,E_b,Ed_r,Ed_g,Ed_b,lux (Ed: direct part).
    #[arg(short, long, value_name = "E.csv")]
    pub output: PathBuf,
    /// Take the light that is stored at the vertices round each point, as the viewer shows it.
    #[arg(long, conflicts_with = "renderer")]
    pub from_bake: bool,
    /// radiosity gathers over a bake; path traces paths, for truth, and adds the columns se_r,se_g,se_b (standard error).
    #[arg(long, value_enum, value_name = "RENDERER", default_value = "radiosity")]
    pub renderer: Renderer,
    /// With path: paths a point, rounded up to a multiple of 32.
    #[arg(long, value_name = "N", default_value = "4096", value_parser = clap::value_parser!(u32).range(16..=1 << 24))]
    pub spp: u32,
    /// With path: light is followed through at most this many reflections [default: to the end].
    #[arg(long, value_name = "K")]
    pub max_bounces: Option<u32>,
    /// How to bake where the file stores no light.
    #[command(flatten)]
    pub bake: BakeOptions,
}

/// Where measured light comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Renderer {
    /// Direct light, and a final gather over a bake.
    Radiosity,
    /// Path tracing.
    Path,
}

/// Measures and writes.
///
/// # Errors
/// The scene or the points cannot be read, the scene cannot be baked, it was stopped, or the table cannot be written.
pub fn run(args: &MeasureArgs, is_quiet: bool) -> Result<()> {
    let points = read_points(&args.points)?;
    let scene = load(&args.scene, &args.variant)?;
    let table = match args.renderer {
        Renderer::Path => truth(&scene, &points, args, is_quiet)?,
        Renderer::Radiosity => radiosity(scene, &points, args, is_quiet)?,
    };
    write_whole(&args.output, table.as_bytes()).with_context(|| format!("{}: cannot be written", args.output.display()))
}

/// Irradiance from the light of the file, or of a bake made now.
fn radiosity(scene: Scene, points: &[MeasuringPoint], args: &MeasureArgs, is_quiet: bool) -> Result<String> {
    let settings = args.bake.settings();
    let lit = match baked::gltf::from_scene(scene) {
        Ok(baked) => {
            let uncut = MeshSettings { element_size: f32::INFINITY, patch_size: f32::INFINITY };
            let mesh = PatchMesh::new(&baked.scene, &uncut)?;
            Lit { scene: None, mesh, baked }
        }
        Err(scene) => {
            let device = bake_device(&settings)?;
            let bake = bake_watched(device.as_ref(), &scene, &settings, None, is_quiet)?;
            if bake.report.cancelled {
                bail!("stopped");
            }
            Lit { scene: Some(scene), mesh: bake.mesh, baked: bake.baked }
        }
    };
    if args.from_bake {
        return table(points, &look_up(&lit.baked, points));
    }
    let watch = TerminalWatch::interruptible(is_quiet)?;
    let scene = lit.scene.as_ref().unwrap_or(&lit.baked.scene);
    let measured = measure(scene, &lit.mesh, &lit.baked, points, &MeasureSettings::preset(settings.quality), &watch);
    watch.finish();
    let measured: Vec<Option<Measured>> = measured.context("stopped")?.into_iter().map(Some).collect();
    table(points, &measured)
}

/// A scene and its light.
struct Lit {
    /// As it was before the bake, where that is known.
    scene: Option<Scene>,
    mesh: PatchMesh,
    baked: BakedScene,
}

/// Irradiance by path tracing.
fn truth(scene: &Scene, points: &[MeasuringPoint], args: &MeasureArgs, is_quiet: bool) -> Result<String> {
    let default = PathSettings::default();
    let settings = PathSettings {
        samples: args.spp,
        max_bounces: args.max_bounces.unwrap_or(default.max_bounces),
        has_specular: false,
        ..default
    };
    let watch = TerminalWatch::interruptible(is_quiet)?;
    let found = raytrace::irradiance(&Tracer::new(scene), points, &settings, &watch);
    watch.finish();
    let found = found.context("stopped")?;
    let rows = points.iter().zip(&found).map(|(point, Irradiance { total, direct, total_error, .. })| {
        let values = [point.position, point.normal, *total, *direct].map(|v| v.to_array());
        [values.as_flattened(), &[luminance(*total)], &total_error.to_array()].concat()
    });
    written(&[COLUMNS.as_slice(), &["se_r", "se_g", "se_b"]].concat(), rows)
}

/// The first columns of every table that is written.
const COLUMNS: [&str; 13] = ["px", "py", "pz", "nx", "ny", "nz", "E_r", "E_g", "E_b", "Ed_r", "Ed_g", "Ed_b", "lux"];

/// A point's values; empty fields would shift nobody, NaN is what readers of numbers know.
fn table(points: &[MeasuringPoint], measured: &[Option<Measured>]) -> Result<String> {
    let unknown = Measured { total: Vec3::NAN, direct: Vec3::NAN };
    let rows = points.iter().zip(measured).map(|(point, measured)| {
        let Measured { total, direct } = measured.unwrap_or(unknown);
        let values = [point.position, point.normal, total, direct].map(|v| v.to_array());
        [values.as_flattened(), &[luminance(total)]].concat()
    });
    written(&COLUMNS, rows)
}

fn written(columns: &[&str], rows: impl Iterator<Item = Vec<f32>>) -> Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(columns)?;
    for row in rows {
        writer.write_record(row.iter().map(f32::to_string))?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

/// Reads a table of points.
fn read_points(path: &Path) -> Result<Vec<MeasuringPoint>> {
    let name = path.display();
    let mut reader =
        csv::ReaderBuilder::new().flexible(true).from_path(path).with_context(|| format!("{name}: cannot be read"))?;
    let header = reader.headers().with_context(|| format!("{name}: cannot be read"))?.clone();
    let mut columns = [0; 6];
    for (column, wanted) in columns.iter_mut().zip(COLUMNS) {
        *column = header
            .iter()
            .position(|title| title.trim() == wanted)
            .with_context(|| format!("{name}: there is no column {wanted} in the header"))?;
    }
    let mut points = Vec::new();
    for record in reader.records() {
        let record = record.with_context(|| format!("{name}: cannot be read"))?;
        let line = record.position().map_or(0, csv::Position::line);
        let mut values = [0.0; 6];
        for (value, column) in values.iter_mut().zip(columns) {
            let text = record.get(column).unwrap_or_default().trim();
            *value = text.parse().ok().filter(|value: &f32| value.is_finite()).with_context(|| {
                format!("{name}, line {line}: \"{text}\" in column {} is no number", &header[column])
            })?;
        }
        let [px, py, pz, nx, ny, nz] = values;
        let normal = Vec3::new(nx, ny, nz).try_normalize();
        let normal = normal.with_context(|| format!("{name}, line {line}: the normal has no direction"))?;
        points.push(MeasuringPoint { position: Vec3::new(px, py, pz), normal });
    }
    Ok(points)
}
