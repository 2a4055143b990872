//! Builds a room in code, bakes it, and prints the illuminance of its floor: no file is read.

use std::error::Error;

use hemicube::base::colour::luminance;
use hemicube::base::ids::TriangleId;
use hemicube::glam::{Quat, Vec3};
use hemicube::scene::{Camera, Material, area_of, normal_of};
use hemicube::{BakeSettings, Quality, SceneBuilder, bake};

fn main() -> Result<(), Box<dyn Error>> {
    let mut builder = SceneBuilder::new("studio");
    // Reflectance and emission are linear RGB; emission is radiance in nit.
    let white = builder.material(Material::diffuse(Vec3::splat(0.75)));
    let red = builder.material(Material::diffuse(Vec3::new(0.6, 0.1, 0.08)));
    let wood = builder.material(Material::diffuse(Vec3::new(0.45, 0.3, 0.18)));

    // Walls face inwards, in the order floor, ceiling, -X, +X, -Z, +Z. Positions are metres, +Y is up.
    builder.room(Vec3::ZERO, Vec3::new(4.0, 2.6, 4.0), [wood, white, red, white, white, white]);
    builder.block(Vec3::new(1.2, 0.4, 1.4), Vec3::splat(0.4), Quat::from_rotation_y(0.4), white);

    // A lamp is a surface with emission. Its light group can be dimmed after the bake.
    let group = Some(builder.group("ceiling lamp"));
    let glow = Material { emission: Vec3::splat(2000.0), group, ..Material::diffuse(Vec3::splat(0.5)) };
    let glow = builder.material(glow);
    let corner = |x: f32, z: f32| Vec3::new(2.0 + x, 2.59, 2.0 + z);
    builder.quad([corner(-0.4, -0.4), corner(0.4, -0.4), corner(0.4, 0.4), corner(-0.4, 0.4)], glow);
    builder.camera(Camera::looking_at("door", Vec3::new(3.6, 1.6, 3.7), Vec3::new(1.0, 0.8, 0.5), 1.0));
    let scene = builder.build();
    println!("{}: {} triangles, {:.1} m2", scene.name, scene.triangles.len(), scene.area());

    let bake = bake(&scene, &BakeSettings::preset(Quality::Draft))?;

    // Triangles of the baked scene are elements; light is stored at their vertices. The mean over the floor is the mean
    // of the corners, weighted by area.
    let (baked, light) = (&bake.baked.scene, &bake.baked.light);
    let illuminance = |vertex: u32| {
        let groups = light.groups.iter();
        luminance(groups.map(|group| group.direct[vertex as usize] + group.indirect[vertex as usize]).sum())
    };
    let (mut lumen, mut area) = (0.0, 0.0);
    for (t, triangle) in baked.triangles.iter().enumerate() {
        let corners = baked.corners(TriangleId::new(t));
        let is_floor = corners.iter().all(|corner| corner.y.abs() < 1e-4) && normal_of(corners).y > 0.0;
        if is_floor {
            lumen += area_of(corners) * triangle.vertices.map(illuminance).iter().sum::<f32>() / 3.0;
            area += area_of(corners);
        }
    }
    println!("{} elements; the floor receives {:.0} lx on average", baked.triangles.len(), lumen / area);
    Ok(())
}
