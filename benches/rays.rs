//! Rays per second: from random points of the surface, cosine-distributed about the front normal, on all cores.
//!
//! On a machine that runs other programs as well, compare the rates per second of processor time (known on Linux only).
//!
//! `cargo bench --bench rays -- [SCENE.glb] [RAYS]`; the built-in Cornell box by default. If EMBREE_PYTHON names a
//! Python with embreex, Embree traces the same rays in the same run, on as many processes as there are threads.

use std::io::Write;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use anyhow::{Context, bail, ensure};
use glam::{Vec2, Vec3};
use hemicube::base::ids::TriangleId;
use hemicube::base::sampling::{cosine_hemisphere, hash, triangle_from_square, unit_float};
use hemicube::base::triangle::interpolate;
use hemicube::scene::{Scene, area_of, builtin, gltf, normal_of};
use hemicube::trace::Tracer;
use rayon::prelude::*;

/// Number of runs, of which the median counts.
const RUNS: usize = 5;

struct Ray {
    origin: Vec3,
    direction: Vec3,
}

fn main() -> anyhow::Result<()> {
    let args: Vec<String> = std::env::args().skip(1).filter(|arg| arg != "--bench").collect();
    let scene = match args.first() {
        Some(path) => gltf::load(Path::new(path))?,
        None => builtin::cornell(),
    };
    let count: u32 = args.get(1).map_or(Ok(1_000_000), |text| text.parse())?;
    let rays = rays(&scene, count);
    let start = Instant::now();
    let tracer = Tracer::new(&scene);
    let built = start.elapsed().as_secs_f64();
    println!("{}: {} triangles, tree built in {built:.3} s", scene.name, scene.triangles.len());
    let nearest = |ray: &Ray| tracer.nearest(ray.origin, ray.direction, f32::INFINITY).is_some();
    let blocked = |ray: &Ray| tracer.transmittance(ray.origin, ray.direction, f32::INFINITY) == 0.0;
    let ours = [Rate::measured(&rays, nearest), Rate::measured(&rays, blocked)];
    let theirs = match std::env::var_os("EMBREE_PYTHON") {
        Some(python) => embree(Path::new(&python), &scene, &rays)?,
        None => Vec::new(),
    };
    for (number, (what, ours)) in ["nearest hit", "any hit    "].iter().zip(&ours).enumerate() {
        println!("{what}  {ours}");
        if let Some(theirs) = theirs.get(number) {
            println!("   Embree    {theirs}");
            println!(
                "    share    {:.2} of Embree's on the wall, {:.2} a processor second",
                ours.a_second / theirs.a_second,
                ours.a_busy_second / theirs.a_busy_second
            );
        }
    }
    Ok(())
}

/// Rays per second.
struct Rate {
    /// Rays a second on all threads.
    a_second: f64,
    /// Rays per second of processor time; NaN if the system does not report it.
    a_busy_second: f64,
    /// Share of the rays that hit.
    hit_share: f64,
}

impl std::fmt::Display for Rate {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [wall, busy] = [self.a_second, self.a_busy_second].map(|rate| rate / 1e6);
        let threads = rayon::current_num_threads();
        let share = self.hit_share;
        write!(f, "{wall:.2} Mrays/s on {threads} threads, {busy:.2} a processor second, {share:.4} of the rays hit")
    }
}

impl Rate {
    fn measured(rays: &[Ray], hits: impl Fn(&Ray) -> bool + Sync) -> Self {
        let mut num_hits = 0;
        let busy_before = processor_seconds();
        let mut seconds: Vec<f64> = (0..RUNS)
            .map(|_| {
                let start = Instant::now();
                num_hits = rays.par_iter().with_min_len(4096).filter(|ray| hits(ray)).count();
                start.elapsed().as_secs_f64()
            })
            .collect();
        let busy = processor_seconds().zip(busy_before).map_or(f64::NAN, |(after, before)| after - before);
        seconds.sort_by(f64::total_cmp);
        let num_rays = rays.len() as f64;
        Self {
            a_second: num_rays / seconds[RUNS / 2],
            a_busy_second: num_rays * RUNS as f64 / busy,
            hit_share: num_hits as f64 / num_rays,
        }
    }
}

/// Measures Embree's rates for the nearest and for any hit.
fn embree(python: &Path, scene: &Scene, rays: &[Ray]) -> anyhow::Result<Vec<Rate>> {
    let corners = (0..scene.triangles.len()).flat_map(|t| scene.corners(TriangleId::new(t)));
    let lines = rays.iter().flat_map(|ray| [ray.origin, ray.direction]);
    let counts = [scene.triangles.len() as u32, rays.len() as u32].map(u32::to_le_bytes);
    let numbers = corners.chain(lines).flat_map(|v| v.to_array()).flat_map(f32::to_le_bytes);
    let mut file = tempfile::NamedTempFile::new()?;
    file.write_all(&counts.concat())?;
    file.write_all(&numbers.collect::<Vec<u8>>())?;
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers/embree_rays.py");
    let answer = Command::new(python)
        .arg(script)
        .arg(file.path())
        .args([rayon::current_num_threads().to_string(), RUNS.to_string()])
        .output()
        .with_context(|| python.display().to_string())?;
    ensure!(answer.status.success(), "{}: {}", python.display(), String::from_utf8_lossy(&answer.stderr));
    let text = String::from_utf8(answer.stdout)?;
    let rate = |line: &str| -> anyhow::Result<Rate> {
        let numbers: Vec<f64> = line.split_whitespace().map(str::parse).collect::<Result<_, _>>()?;
        let [a_second, a_busy_second, hit_share] = numbers[..] else { bail!("not three numbers: {line}") };
        Ok(Rate { a_second, a_busy_second, hit_share })
    };
    text.lines().map(rate).collect()
}

/// Returns the processor time of this program, summed over all threads, or `None` if the system does not report it.
fn processor_seconds() -> Option<f64> {
    // Fields 14 and 15 of proc(5), in hundredths of a second; the second field, a name in brackets, may contain blanks.
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<&str> = text.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks = |field: usize| fields.get(field - 3)?.parse::<f64>().ok();
    Some((ticks(14)? + ticks(15)?) / 100.0)
}

/// Returns rays from points distributed over the surface by area, in random order.
fn rays(scene: &Scene, count: u32) -> Vec<Ray> {
    let mut whole = 0.0;
    let triangles = (0..scene.triangles.len()).map(TriangleId::new);
    let area_until: Vec<f32> = triangles
        .map(|t| {
            whole += area_of(scene.corners(t));
            whole
        })
        .collect();
    let height = 1e-5 * scene.bounds().extent();
    let ray = |i: u32| {
        let number = |k: u32| unit_float(hash(hash(i) ^ k));
        let at = area_until.partition_point(|&area| area <= number(1) * whole).min(area_until.len() - 1);
        let corners = scene.corners(TriangleId::new(at));
        let weights = triangle_from_square(Vec2::new(number(2), number(3)));
        let normal = normal_of(corners);
        let point = interpolate(corners, weights);
        Ray { origin: point + height * normal, direction: cosine_hemisphere(normal, Vec2::new(number(4), number(5))) }
    };
    (0..count).map(ray).collect()
}
