//! Compares irradiance by path tracing with a table of another path tracer.
//!
//! `cargo bench --bench path_tracing -- SCENE.glb REFERENCE.csv [SAMPLES] [MAX_BOUNCES]`; the columns of the table are
//! px,py,pz, nx,ny,nz,E_r,E_g,E_b,Ed_r,Ed_g,Ed_b,se_r,se_g,se_b. Points agree within three standard errors of the
//! difference.

use std::path::Path;
use std::time::Instant;

use anyhow::{Context, bail};
use glam::Vec3;
use hemicube::base::progress::Unwatched;
use hemicube::raytrace::{Irradiance, MeasuringPoint, PathSettings, irradiance};
use hemicube::scene::gltf;
use hemicube::trace::Tracer;

/// A row of the table.
struct Row {
    point: MeasuringPoint,
    irradiance: Vec3,
    direct: Vec3,
    error: Vec3,
}

fn main() -> anyhow::Result<()> {
    let args: Vec<String> = std::env::args().skip(1).filter(|arg| arg != "--bench").collect();
    let [scene, table, rest @ ..] = args.as_slice() else {
        println!("nothing to compare: give SCENE.glb REFERENCE.csv");
        return Ok(());
    };
    let scene = gltf::load(Path::new(scene))?;
    let rows = read(Path::new(table))?;
    let points: Vec<_> = rows.iter().map(|row| row.point).collect();
    let settings = PathSettings {
        samples: rest.first().map_or(Ok(1024), |text| text.parse())?,
        max_bounces: rest.get(1).map_or(Ok(u32::MAX), |text| text.parse())?,
        has_specular: false,
        ..PathSettings::default()
    };
    let tracer = Tracer::new(&scene);
    let start = Instant::now();
    let found = irradiance(&tracer, &points, &settings, &Unwatched).context("nothing cancels")?;
    report(&scene.name, &rows, &found, settings.samples, start.elapsed().as_secs_f64());
    Ok(())
}

fn read(path: &Path) -> anyhow::Result<Vec<Row>> {
    let text = std::fs::read_to_string(path).with_context(|| path.display().to_string())?;
    text.lines().skip(1).map(row).collect()
}

fn row(line: &str) -> anyhow::Result<Row> {
    let numbers: Vec<f32> = line.split(',').map_while(|field| field.parse().ok()).collect();
    let [px, py, pz, nx, ny, nz, er, eg, eb, dr, dg, db, sr, sg, sb, ..] = numbers[..] else {
        bail!("a line without 15 numbers: {line}");
    };
    let point = MeasuringPoint { position: Vec3::new(px, py, pz), normal: Vec3::new(nx, ny, nz) };
    let [irradiance, direct, error] = [[er, eg, eb], [dr, dg, db], [sr, sg, sb]].map(Vec3::from);
    Ok(Row { point, irradiance, direct, error })
}

fn report(name: &str, rows: &[Row], found: &[Irradiance], samples: u32, seconds: f64) {
    let count = rows.len() as f32;
    let mean = rows.iter().map(|row| row.irradiance).sum::<Vec3>() / count;
    let mean_direct = rows.iter().map(|row| row.direct).sum::<Vec3>() / count;
    let mut close = 0;
    let (mut difference, mut direct_difference, mut squares, mut theirs, mut ours) =
        (Vec3::ZERO, Vec3::ZERO, 0.0, 0.0, 0.0);
    for (row, found) in rows.iter().zip(found) {
        let off = found.total - row.irradiance;
        let error = (found.total_error * found.total_error + row.error * row.error).map(f32::sqrt);
        // Without noise, the rounding errors of single precision remain.
        close += usize::from(off.abs().cmple(3.0 * error + 1e-4 * row.irradiance + 1e-6 * mean).all());
        difference += off / count;
        direct_difference += (found.direct - row.direct) / count;
        squares += off.length_squared() / count;
        theirs += row.error.length_squared() / count;
        ours += found.total_error.length_squared() / count;
    }
    let percent = |square: f32| 100.0 * square.sqrt() / mean.length();
    println!(
        "{name}: {:.1} % of {count} points within 3 standard errors; difference {:.2} % rms, noise theirs {:.2} %, ours {:.2} % \
         at {samples} samples; bias {:+.2} %, of direct light {:+.2} %; {seconds:.1} s",
        100.0 * close as f32 / count,
        percent(squares),
        percent(theirs),
        percent(ours),
        100.0 * difference.element_sum() / mean.element_sum(),
        100.0 * direct_difference.element_sum() / mean_direct.element_sum().max(f32::MIN_POSITIVE),
    );
}
