//! Hemicubes per second of the full loop (draw, read back, sum) and of drawing and reading back alone, in one run.
//!
//! `cargo bench --bench hemicubes -- [SCENE.glb] [SIZE_PX]`; without a scene the built-in Cornell box.

use std::path::PathBuf;
use std::time::Instant;

use hemicube::form_factor::hemicube::Hemicubes;
use hemicube::form_factor::{FormFactorSource, Viewpoint};
use hemicube::gpu::Gpu;
use hemicube::patch::{MeshSettings, PatchMesh};
use hemicube::radiosity::Viewpoints;
use hemicube::scene::{Scene, builtin, gltf};

/// Hemicubes per timed run.
const COUNT: usize = 4096;
/// Number of runs, of which the fastest counts.
const RUNS: usize = 3;

fn main() -> anyhow::Result<()> {
    let args: Vec<String> = std::env::args().skip(1).filter(|arg| arg != "--bench").collect();
    let scene = match args.first() {
        Some(path) => gltf::load(&PathBuf::from(path))?,
        None => builtin::cornell(),
    };
    let size_px: u32 = args.get(1).map_or(Ok(64), |text| text.parse())?;
    let gpu = Gpu::headless()?;
    println!("{}: {} triangles, {size_px} px, {}", scene.name, scene.triangles.len(), gpu.name());
    let coarse = (scene.area() / 2000.0).sqrt() as f32;
    let few = time(&gpu, &scene, coarse, size_px)?;
    let many = time(&gpu, &scene, coarse / 2.0, size_px)?;
    println!("full loop / drawing alone                  {:.3}", few.full / few.draw);
    println!("time a hemicube, 4 x elements / elements   {:.3}", few.full / many.full);
    Ok(())
}

struct Rates {
    full: f64,
    draw: f64,
}

fn time(gpu: &Gpu, scene: &Scene, element_size: f32, size_px: u32) -> anyhow::Result<Rates> {
    let mesh = PatchMesh::new(scene, &MeshSettings { element_size, patch_size: 4.0 * element_size })?;
    let all = Viewpoints::new(scene).at_light_vertices(&mesh);
    let viewpoints: Vec<Viewpoint> = all.iter().copied().cycle().take(COUNT).collect();
    let mut hemicubes = Hemicubes::new(gpu, scene, &mesh, size_px);
    let mut best = Rates { full: 0.0, draw: 0.0 };
    for _ in 0..RUNS {
        let start = Instant::now();
        hemicubes.rows(&viewpoints, &|| true, &|_, row| {
            std::hint::black_box(row.entries.len());
        })?;
        best.full = best.full.max(COUNT as f64 / start.elapsed().as_secs_f64());
        let start = Instant::now();
        hemicubes.draw_only(&viewpoints)?;
        best.draw = best.draw.max(COUNT as f64 / start.elapsed().as_secs_f64());
    }
    println!(
        "{:>8} elements: {:>6.0} hemicubes/s full loop, {:>6.0} drawn and read back",
        mesh.elements.len(),
        best.full,
        best.draw
    );
    Ok(best)
}
