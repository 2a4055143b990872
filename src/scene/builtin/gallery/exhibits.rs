//! Exhibits of the gallery: sculptures, pictures, and a bench.

use glam::{Quat, Vec2, Vec3};

use super::super::builder::{Builder, paint};
use super::super::images;
use super::super::round::{lathe, sphere, torus, twisted_prism};
use super::super::shape::{Shape, Side, cuboid, polygon};
use super::finishes::Finishes;
use super::rooms::{DAIS_HEIGHT, PEDESTAL, PEDESTALS};

/// Adds a sculpture on each pedestal and a vase on the dais.
pub(super) fn sculptures(builder: &mut Builder, finishes: &Finishes) {
    for (name, [x, z]) in PEDESTALS {
        let top = Vec3::new(x + PEDESTAL / 2.0, DAIS_HEIGHT, z + PEDESTAL / 2.0);
        let (material, shape) = match name {
            "torus" => (finishes.bronze, standing_torus()),
            "sphere" => (finishes.plaster, sphere(0.25, 24, 12).moved(Vec3::Y * 0.25)),
            _ => (finishes.plaster, twisted_prism(0.2, 0.85, 0.3, 5, 12)),
        };
        builder.place(name, material, shape.moved(top));
    }
    let outside = [(0.16, 0.0), (0.30, 0.35), (0.33, 0.60), (0.24, 0.88), (0.12, 1.02), (0.17, 1.15), (0.15, 1.15)];
    let inside = [(0.15, 1.15), (0.10, 1.02), (0.20, 0.88), (0.0, 0.80)];
    let vase = lathe(&outside.map(Vec2::from), 16).join(lathe(&inside.map(Vec2::from), 16));
    builder.place("vase", finishes.clay, vase.moved(Vec3::new(9.5, DAIS_HEIGHT, 6.4)));
}

/// Returns an upright ring on a small foot, rotated slightly out of the direction of the wall.
fn standing_torus() -> Shape {
    let upright = torus(0.30, 0.085, 24, 10).turned(Quat::from_rotation_x(std::f32::consts::FRAC_PI_2));
    let foot = cuboid(Vec3::new(-0.12, 0.0, -0.08), Vec3::new(0.12, 0.06, 0.08), &[Side::Below]);
    upright.moved(Vec3::Y * 0.42).join(foot).turned(Quat::from_rotation_y(0.6))
}

/// Adds framed pictures on the walls.
pub(super) fn pictures(builder: &mut Builder, finishes: &Finishes) {
    let [composition, rings, fields, hills] =
        [images::composition(), images::rings(), images::fields(), images::hills()].map(|image| builder.texture(image));
    // Name, image, size, middle on the wall, and number of quarter turns from facing south.
    let hung = [
        ("composition", composition, [1.20, 0.90], [1.5, 1.65, 0.0], 0),
        ("rings", rings, [1.10, 1.10], [3.4, 1.65, 0.0], 0),
        ("fields", fields, [0.90, 1.35], [5.0, 1.70, 0.0], 0),
        ("hills", hills, [2.24, 1.40], [10.2, 2.75, 3.6], 3),
        ("study in circles", rings, [0.80, 0.80], [-2.2, 1.60, 0.0], 0),
        ("evening", fields, [0.80, 1.20], [-4.6, 1.60, 5.7], 2),
    ];
    for (name, image, size, middle, turns) in hung {
        let place = |shape: Shape| shape.quarter_turned(turns).moved(Vec3::from(middle));
        let size = Vec2::from(size);
        let material = builder.textured(paint(name, [0.9; 3]), image);
        builder.place(name, material, place(canvas(size)));
        builder.place(&format!("frame of {name}"), finishes.black, place(frame(size)));
    }
}

/// Returns a picture of this size before the wall at z = 0.
fn canvas(size: Vec2) -> Shape {
    let corners = corners(size, 0.02);
    polygon(&corners).with_uv(|at| Vec2::new(at.x / size.x + 0.5, 0.5 - at.y / size.y))
}

/// Returns a mitred frame round a picture: inner side, front, outer side.
fn frame(size: Vec2) -> Shape {
    let wide = size + 0.10;
    let rims = [corners(size, 0.02), corners(size, 0.05), corners(wide, 0.05), corners(wide, 0.0)];
    rims.windows(2)
        .flat_map(|rims| {
            let (inner, outer) = (rims[0], rims[1]);
            (0..4).map(move |i| polygon(&[inner[i], outer[i], outer[(i + 1) % 4], inner[(i + 1) % 4]]))
        })
        .collect()
}

/// Returns the corners of an upright rectangle about the origin, counter-clockwise as seen from the south.
fn corners(size: Vec2, z: f32) -> [Vec3; 4] {
    [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)].map(|(x, y)| Vec3::new(x * size.x, y * size.y, z))
}

/// Adds a bench before the pictures of the hall.
pub(super) fn bench(builder: &mut Builder, finishes: &Finishes) {
    let part = |low: [f32; 3], high: [f32; 3], open: &[Side]| cuboid(low.into(), high.into(), open);
    // The legs end at the underside of the seat and have no end faces.
    let leg = |x: f32| part([x, 0.0, 2.05], [x + 0.06, 0.40, 2.45], &[Side::Above, Side::Below]);
    let seat = part([2.5, 0.40, 2.0], [4.3, 0.45, 2.5], &[]);
    let bench = seat.join(leg(2.7)).join(leg(4.04));
    builder.place("bench", finishes.walnut, bench.with_uv(|at| Vec2::new(at.z + at.y, at.x) / 1.2));
}
