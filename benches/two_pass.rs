//! Compares two-pass ray tracing with path tracing of the same picture: error, bias and time, in one run.
//!
//! `cargo bench --bench two_pass -- [SCENE.glb[=REFERENCE.exr] ...]`; by default the built-in scenes whose lamps paths
//! can find. The time of two passes includes the bake. With a reference, the mean radiance of both pictures is compared
//! with that of the reference, at its size. PATH_SPP is the number of paths a pixel [default: 1024], SIZE the larger
//! side [default: 320].

use std::path::Path;
use std::time::Instant;

use anyhow::Context;
use glam::Vec3;
use hemicube::bake::{BakeSettings, Quality, bake};
use hemicube::base::colour::luminance;
use hemicube::base::progress::Unwatched;
use hemicube::raytrace::{Film, PathSettings, TwoPassSettings, path_traced, two_pass};
use hemicube::render::{FileKind, Raster, compare};
use hemicube::scene::{Camera, Scene, builtin, gltf};
use hemicube::trace::Tracer;

fn main() -> anyhow::Result<()> {
    let args: Vec<String> = std::env::args().skip(1).filter(|arg| arg != "--bench").collect();
    if args.is_empty() {
        for scene in [builtin::cornell(), builtin::mirrors()] {
            measure(&scene, None)?;
        }
    }
    for arg in &args {
        let (scene, reference) = match arg.split_once('=') {
            Some((scene, reference)) => (scene, Some(Raster::load(Path::new(reference))?)),
            None => (arg.as_str(), None),
        };
        let scene = match scene.strip_prefix(builtin::PREFIX) {
            Some(name) => builtin::by_name(name).context("there is no such built-in scene")?,
            None => gltf::load(Path::new(scene))?,
        };
        measure(&scene, reference.as_ref())?;
    }
    Ok(())
}

/// Renders the same picture both ways and prints the differences.
fn measure(scene: &Scene, reference: Option<&Raster>) -> anyhow::Result<()> {
    let camera = scene.cameras.first().cloned().unwrap_or_else(|| Camera::framing(scene.bounds()));
    let size = match reference {
        Some(reference) => reference.size,
        None => {
            let side = setting("SIZE", 320)?;
            [side, side * 3 / 4]
        }
    };
    let paths = PathSettings { samples: setting("PATH_SPP", 1024)?, ..PathSettings::default() };
    let start = Instant::now();
    let truth = path_traced(&Tracer::new(scene), &camera, size, &paths, &Unwatched);
    let path_seconds = start.elapsed().as_secs_f64();

    let start = Instant::now();
    let baked = bake(scene, &BakeSettings::preset(Quality::Medium))?.baked;
    let bake_seconds = start.elapsed().as_secs_f64();
    let settings = TwoPassSettings::default();
    let picture = two_pass(&Tracer::new(&baked.scene), &baked, &camera, size, &settings, &Unwatched);
    let seconds = start.elapsed().as_secs_f64();

    let difference = compare(&raster(&picture), &raster(&truth))?;
    let [ours, theirs] = [picture.noise(), truth.noise()].map(|noise| 100.0 * noise.pixel);
    println!(
        "{}: two-pass at {} samples against {} paths a pixel, {}x{}: relative RMSE {:.2} % (noise {ours:.2} and {theirs:.2} %), \
         mean {:+.2} %; {seconds:.1} s ({bake_seconds:.1} s of it the bake) against {path_seconds:.1} s, a share of {:.3}",
        scene.name,
        picture.samples(),
        truth.samples(),
        size[0],
        size[1],
        100.0 * difference.relative_rmse,
        100.0 * difference.mean_difference,
        seconds / path_seconds,
    );
    if let Some(reference) = reference {
        let expected = mean(&reference.pixels);
        let off = |film: &Film| 100.0 * (mean(&raster(film).pixels) / expected - 1.0);
        println!(
            "{}: mean radiance against the reference: paths {:+.2} %, two-pass {:+.2} %",
            scene.name,
            off(&truth),
            off(&picture)
        );
    }
    Ok(())
}

/// Returns a number from the environment, or the default.
fn setting(name: &str, default: u32) -> anyhow::Result<u32> {
    std::env::var(name).map_or(Ok(default), |text| text.parse().context(name.to_owned()))
}

fn raster(film: &Film) -> Raster {
    let pixels = film.radiance().into_iter().map(|[r, g, b, _]| Vec3::new(r, g, b)).collect();
    Raster { size: film.size(), pixels, kind: FileKind::Radiance }
}

/// Mean luminance.
fn mean(pixels: &[Vec3]) -> f64 {
    pixels.iter().map(|&pixel| f64::from(luminance(pixel))).sum::<f64>() / pixels.len() as f64
}
