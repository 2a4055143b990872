//! Rays per second: from random points of the surface, cosine-distributed about the front normal, on all cores.
//!
//! On a machine that others use too, compare the rates a second of processor time (told on Linux).
//!
//! `cargo bench --bench rays -- [SCENE.glb] [RAYS]`; without a scene the built-in Cornell box.

use std::path::Path;
use std::time::Instant;

use glam::{Vec2, Vec3};
use hemicube::base::ids::TriangleId;
use hemicube::base::sampling::{cosine_hemisphere, hash, triangle_from_square, unit_float};
use hemicube::scene::{Scene, area_of, builtin, gltf, normal_of};
use hemicube::trace::Tracer;
use rayon::prelude::*;

/// Runs of which the median counts.
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
    time("nearest hit", &rays, nearest);
    time("any hit    ", &rays, blocked);
    Ok(())
}

fn time(what: &str, rays: &[Ray], hits: impl Fn(&Ray) -> bool + Sync) {
    let mut num_hits = 0;
    let busy_before = processor_seconds();
    let mut seconds: Vec<f64> = (0..RUNS)
        .map(|_| {
            let start = Instant::now();
            num_hits = rays.par_iter().with_min_len(4096).filter(|ray| hits(ray)).count();
            start.elapsed().as_secs_f64()
        })
        .collect();
    let busy = processor_seconds().zip(busy_before).map(|(after, before)| after - before);
    seconds.sort_by(f64::total_cmp);
    let millions = rays.len() as f64 / 1e6;
    let a_busy_second =
        busy.map_or(String::new(), |busy| format!("{:.2} a processor second, ", millions * RUNS as f64 / busy));
    println!(
        "{what}  {:.2} Mrays/s on {} threads, {a_busy_second}{:.3} of the rays hit",
        millions / seconds[RUNS / 2],
        rayon::current_num_threads(),
        num_hits as f64 / rays.len() as f64
    );
}

/// Time that the processor has spent in this program, all threads together; none where the system does not tell.
fn processor_seconds() -> Option<f64> {
    // Fields 14 and 15 of proc(5), in hundredths of a second; the second field, a name in brackets, may hold blanks.
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<&str> = text.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks = |field: usize| fields.get(field - 3)?.parse::<f64>().ok();
    Some((ticks(14)? + ticks(15)?) / 100.0)
}

/// Rays from points spread over the surface by area, in no order.
fn rays(scene: &Scene, count: u32) -> Vec<Ray> {
    let mut whole = 0.0;
    let triangles = (0..scene.triangles.len()).map(TriangleId::new);
    let area_until: Vec<f32> = triangles
        .map(|t| {
            whole += area_of(scene.corners(t));
            whole
        })
        .collect();
    let (low, high) = scene.bounds();
    let height = 1e-5 * (high - low).max_element();
    let ray = |i: u32| {
        let number = |k: u32| unit_float(hash(hash(i) ^ k));
        let at = area_until.partition_point(|&area| area <= number(1) * whole).min(area_until.len() - 1);
        let corners = scene.corners(TriangleId::new(at));
        let weights = triangle_from_square(Vec2::new(number(2), number(3)));
        let normal = normal_of(corners);
        let point = corners[0] * weights.x + corners[1] * weights.y + corners[2] * weights.z;
        Ray { origin: point + height * normal, direction: cosine_hemisphere(normal, Vec2::new(number(4), number(5))) }
    };
    (0..count).map(ray).collect()
}
