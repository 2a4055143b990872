//! A room with a mirror, metal and glass, whose specular light needs the second, ray-traced pass.

use glam::{Quat, Vec3};

use super::builder::{Builder, paint};
use super::round::sphere;
use super::shape::{Shape, Side, cuboid, polygon};
use crate::scene::{Material, Scene};

/// Maximum corner of the room, metres; the minimum corner is the origin.
const ROOM: Vec3 = Vec3::new(4.0, 3.0, 4.0);

/// Returns a closed room, 4 m wide, with a lamp, a mirror on the wall, a block of copper, a silver ball, and a pane of
/// green glass.
#[must_use]
pub fn mirrors() -> Scene {
    let mut builder = Builder::new("mirrors");
    let white = builder.material(paint("white", [0.73, 0.72, 0.70]));
    let red = builder.material(paint("red", [0.60, 0.08, 0.06]));
    let oak = builder.material(paint("oak", [0.45, 0.30, 0.18]));
    let silver = builder.material(metal("silver", [0.95, 0.93, 0.88], 0.0));
    let copper = builder.material(metal("copper", [0.93, 0.62, 0.50], 0.35));
    let glass =
        builder.material(Material { transmission: 1.0, roughness: 0.0, ..paint("green glass", [0.70, 0.92, 0.80]) });
    let lamp = builder.glowing(paint("lamp", [0.78; 3]), Vec3::new(600.0, 540.0, 450.0), "lamp");

    let walls = cuboid(Vec3::ZERO, ROOM, &[Side::Below, Side::West]).inside_out();
    builder.place("walls and ceiling", white, walls);
    let only = |side: Side| -> Vec<Side> { Side::ALL.into_iter().filter(|&other| other != side).collect() };
    builder.place("floor", oak, cuboid(Vec3::ZERO, ROOM, &only(Side::Below)).inside_out());
    builder.place("left wall", red, cuboid(Vec3::ZERO, ROOM, &only(Side::West)).inside_out());
    builder.place("lamp", lamp, polygon(&rectangle([1.5, 2.96, 1.3], Vec3::X, Vec3::Z, [1.0, 0.8])));
    builder.place("mirror", silver, polygon(&rectangle([3.96, 0.4, 0.8], Vec3::Z, Vec3::Y, [2.4, 2.0])));
    let block = cuboid(Vec3::new(-0.4, 0.0, -0.4), Vec3::new(0.4, 1.3, 0.4), &[Side::Below]);
    builder.place("copper block", copper, standing(block, 0.35, [1.1, 0.0, 1.1]));
    builder.place("plinth", white, standing(plinth(), 0.2, [2.6, 0.0, 1.0]));
    builder.place("silver ball", silver, sphere(0.35, 48, 24).moved(Vec3::new(2.6, 0.85, 1.0)));
    let pane = cuboid(Vec3::new(-0.5, 0.0, -0.01), Vec3::new(0.5, 1.1, 0.01), &[Side::Below]);
    builder.place("pane", glass, standing(pane, -0.5, [2.3, 0.0, 2.4]));
    builder.camera("camera", [1.6, 1.6, 7.6], [2.0, 1.3, 2.0], 40.0);
    builder.finish()
}

fn metal(name: &str, colour: [f32; 3], roughness: f32) -> Material {
    Material { metallic: 1.0, roughness, ..paint(name, colour) }
}

fn plinth() -> Shape {
    cuboid(Vec3::new(-0.3, 0.0, -0.3), Vec3::new(0.3, 0.5, 0.3), &[Side::Below])
}

/// Returns the shape rotated by `turn` radians about +Y and moved to `place`.
fn standing(shape: Shape, turn: f32, place: [f32; 3]) -> Shape {
    shape.turned(Quat::from_rotation_y(turn)).moved(place.into())
}

/// Returns the corners of a rectangle with the normal `u` x `v`.
fn rectangle(corner: [f32; 3], u: Vec3, v: Vec3, [width, height]: [f32; 2]) -> [Vec3; 4] {
    let corner = Vec3::from(corner);
    [corner, corner + width * u, corner + width * u + height * v, corner + height * v]
}
