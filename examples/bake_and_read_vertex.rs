//! Bakes a scene, writes it as a .glb, reads the file again, and prints the light at one of its vertices.
//!
//! `cargo run --example bake_and_read_vertex [SCENE.glb]`: without a file it bakes the built-in Cornell box.

use std::error::Error;
use std::path::Path;

use hemicube::base::colour::luminance;
use hemicube::glam::Vec3;
use hemicube::scene::builtin;
use hemicube::{BakeSettings, BakedScene, Quality, bake, baked, load};

fn main() -> Result<(), Box<dyn Error>> {
    let scene = match std::env::args().nth(1) {
        Some(path) => load(Path::new(&path))?,
        None => builtin::cornell(),
    };

    // The draft preset takes seconds. `bake` uses the CPU; `bake::bake_with` can draw hemicubes on a GPU.
    let bake = bake(&scene, &BakeSettings::preset(Quality::Draft))?;
    println!("{}: {} elements", scene.name, bake.baked.scene.triangles.len());

    // A baked file is a standard .glb. The exposure is for programs that cannot read the stored light in lux.
    let path = std::env::temp_dir().join("hemicube-example.glb");
    baked::gltf::write(&path, &bake.baked, baked::exposure::suited(&bake.baked))?;
    let BakedScene { scene, light, .. } =
        baked::gltf::from_scene(load(&path)?).map_err(|scene| format!("{} stores no light", scene.name))?;
    println!("{}: {} vertices", path.display(), scene.vertices.len());

    // The vertex that is nearest to the middle of the floor.
    let bounds = scene.bounds();
    let middle = Vec3::new(bounds.centre().x, bounds.low.y, bounds.centre().z);
    let distance = |vertex: usize| scene.vertices[vertex].position.distance(middle);
    let nearest =
        (0..scene.vertices.len()).min_by(|&a, &b| distance(a).total_cmp(&distance(b))).ok_or("no vertices")?;
    println!("vertex {nearest} at {:.2} m", scene.vertices[nearest].position);

    // Direct and indirect irradiance are stored apart, and for each light group.
    for (name, group) in scene.light_groups.iter().zip(&light.groups) {
        let [direct, indirect] = [group.direct[nearest], group.indirect[nearest]].map(luminance);
        println!("  {name}: {direct:.2} lx direct, {indirect:.2} lx indirect");
    }
    std::fs::remove_file(&path)?;
    Ok(())
}
