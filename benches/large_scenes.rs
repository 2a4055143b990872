//! Large scenes: hemicubes per second with and without culling, patches per triangle, and the memory of a bake against
//! its forecast, in one run.
//!
//! `cargo bench --bench large_scenes -- [SCENE.glb]`; besides the file it takes a generated scene of 200,000 triangles.

use std::path::PathBuf;
use std::process::Command;
use std::time::Instant;

use glam::Vec3;
use hemicube::bake::{BakeContext, BakeSettings, Forecast, Quality, bake_with};
use hemicube::base::ids::{InstanceId, MaterialId};
use hemicube::form_factor::hemicube::Hemicubes;
use hemicube::form_factor::{FormFactorSource, Viewpoint};
use hemicube::gpu::Gpu;
use hemicube::patch::PatchMesh;
use hemicube::radiosity::Viewpoints;
use hemicube::scene::{Instance, Light, Material, Scene, Triangle, Vertex, gltf};

/// Hemicubes timed a run, and their width.
const COUNT: usize = 256;
const SIZE_PX: u32 = 64;

/// Argument that makes the bench bake a scene and print its memory, in a separate process, because peak memory is
/// measured per process.
const BAKE: &str = "--bake-of";

fn main() -> anyhow::Result<()> {
    let args: Vec<String> = std::env::args().skip(1).filter(|arg| arg != "--bench").collect();
    if let Some(name) = args.iter().position(|arg| arg == BAKE).and_then(|at| args.get(at + 1)) {
        return print_memory(&scene_of(name)?);
    }
    for name in args.first().map(String::as_str).into_iter().chain(["generated"]) {
        let scene = scene_of(name)?;
        print_rates(&scene)?;
        // The child process runs this program again.
        let child = Command::new(std::env::current_exe()?).args([BAKE, name]).output()?;
        print!("{}", String::from_utf8_lossy(&child.stdout));
    }
    Ok(())
}

fn scene_of(name: &str) -> anyhow::Result<Scene> {
    Ok(if name == "generated" { generated() } else { gltf::load(&PathBuf::from(name))? })
}

fn print_rates(scene: &Scene) -> anyhow::Result<()> {
    let gpu = Gpu::headless()?;
    let settings = BakeSettings::preset(Quality::Medium);
    let mesh = PatchMesh::new(scene, &settings.mesh_settings(scene))?;
    println!("{}: {} triangles, {SIZE_PX} px, {}", scene.name, scene.triangles.len(), gpu.name());
    let (triangles, patches) = (scene.triangles.len(), mesh.patches.len());
    println!("  patches {patches}, {:.3} of the triangles", patches as f64 / triangles as f64);
    let all = Viewpoints::new(scene).at_light_vertices(&mesh);
    let viewpoints: Vec<Viewpoint> = all.iter().step_by((all.len() / COUNT).max(1)).take(COUNT).copied().collect();
    let culled = rate(Hemicubes::new(&gpu, scene, &mesh, SIZE_PX), &viewpoints)?;
    let whole = rate(Hemicubes::new(&gpu, scene, &mesh, SIZE_PX).without_culling(), &viewpoints)?;
    println!("  {culled:.1} hemicubes/s culled, {whole:.1} not: {:.2} times", culled / whole);
    Ok(())
}

fn rate(mut hemicubes: Hemicubes<'_>, viewpoints: &[Viewpoint]) -> anyhow::Result<f64> {
    let mut draw = |viewpoints: &[Viewpoint]| {
        hemicubes.rows(viewpoints, &|| true, &|_, row| {
            std::hint::black_box(row.entries.len());
        })
    };
    // Drivers compile shaders at the first draw, which is not timed.
    draw(&viewpoints[..1])?;
    let start = Instant::now();
    draw(viewpoints)?;
    Ok(viewpoints.len() as f64 / start.elapsed().as_secs_f64())
}

fn print_memory(scene: &Scene) -> anyhow::Result<()> {
    let settings = BakeSettings::preset(Quality::Draft);
    let forecast = Forecast::of(scene, &settings)?.bytes as f64;
    let gpu = Gpu::headless()?;
    let report = bake_with(scene, &settings, &BakeContext::on(&gpu))?.report;
    if let Some(peak) = report.memory_bytes.peak {
        let mib = |bytes: f64| bytes / f64::from(1 << 20);
        let ratio = peak as f64 / forecast;
        println!("  draft bake: {:.0} MiB, {:.0} predicted: {ratio:.2} times", mib(peak as f64), mib(forecast));
    }
    Ok(())
}

/// A hall with rows of balls: 200,000 triangles in 200 instances.
fn generated() -> Scene {
    let mut scene = Scene { name: "generated".to_owned(), light_groups: vec!["lamp".to_owned()], ..Scene::default() };
    let material = Material::diffuse(Vec3::splat(0.7));
    scene.materials.push(material);
    // The hall is a ball whose triangles face inwards.
    ball(&mut scene, Vec3::new(10.0, 4.0, 5.0), -40.0, 16);
    for i in 0..200 {
        let place = Vec3::new((i % 20) as f32, 0.0, (i / 20) as f32);
        ball(&mut scene, place, 0.4, 16);
    }
    scene
        .lights
        .push(Light { name: "lamp".to_owned(), ..Light::point(Vec3::new(10.0, 6.0, 5.0), Vec3::splat(5000.0)) });
    scene
}

/// A ball of 4 n^2 - 2 n triangles; with a negative radius they face inwards.
fn ball(scene: &mut Scene, centre: Vec3, radius: f32, n: u32) {
    let (first, first_triangle) = (scene.vertices.len() as u32, scene.triangles.len());
    let (rings, around) = (n, 2 * n);
    for ring in 0..=rings {
        for step in 0..=around {
            let (height, turn) = (ring as f32 / rings as f32, step as f32 / around as f32);
            let (polar, azimuth) = (height * std::f32::consts::PI, (turn * std::f32::consts::TAU));
            let out = Vec3::new(polar.sin() * azimuth.sin(), polar.cos(), polar.sin() * azimuth.cos());
            let normal = out * radius.signum();
            let position = centre + out * radius.abs();
            scene.vertices.push(Vertex::new(position, normal));
        }
    }
    let instance = InstanceId::new(scene.instances.len());
    for ring in 0..rings {
        for step in 0..around {
            let [a, b] = [ring, ring + 1].map(|r| first + r * (around + 1) + step);
            for [p, q, r] in [[a, b, b + 1], [a, b + 1, a + 1]] {
                let vertices = if radius < 0.0 { [p, r, q] } else { [p, q, r] };
                let triangle = Triangle { vertices, material: MaterialId(0), instance };
                let corners = vertices.map(|v| scene.vertices[v as usize].position);
                if hemicube::scene::area_of(corners) > 1e-9 {
                    scene.triangles.push(triangle);
                }
            }
        }
    }
    let triangles = first_triangle..scene.triangles.len();
    scene.instances.push(Instance { name: format!("ball {}", instance.0), triangles });
}
