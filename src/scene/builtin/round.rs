//! Surfaces of revolution and twisted prisms about the +Y axis.

use std::f64::consts::TAU;

use glam::{Vec2, Vec3};

use super::shape::{Shape, polygon};
use crate::scene::Vertex;

/// Cosine of the crease angle, 50 degrees: neighbouring bands whose normals differ by less are shaded smoothly.
const CREASE: f32 = 0.643;

/// Returns the point of the unit circle at `share` of a turn. It is computed in double precision, so that it rounds to
/// the same single-precision value on every machine.
fn on_circle(share: f64) -> Vec2 {
    Vec2::new((share * TAU).cos() as f32, (share * TAU).sin() as f32)
}

/// Surface of revolution: a profile of (radius, height) points rotated about +Y, with `sides` flat sides that are
/// shaded smoothly.
///
/// The front faces are on the right of the profile's direction: outside for a profile that goes upward.
pub(super) fn lathe(profile: &[Vec2], sides: u32) -> Shape {
    let bands: Vec<[Vec2; 2]> = profile.windows(2).map(|ends| [ends[0], ends[1]]).collect();
    let normals: Vec<Vec2> = bands.iter().map(|[low, high]| -(*high - *low).perp().normalize()).collect();
    let shared = |band: usize, other: Option<usize>| match other.and_then(|other| normals.get(other)) {
        Some(other) if other.dot(normals[band]) > CREASE => (normals[band] + *other).normalize(),
        _ => normals[band],
    };
    (0..bands.len())
        .map(|band| ring(bands[band], [shared(band, band.checked_sub(1)), shared(band, Some(band + 1))], sides))
        .collect()
}

/// One band of a surface of revolution between two (radius, height) points with their (radial, upward) normals.
fn ring([low, high]: [Vec2; 2], normals: [Vec2; 2], sides: u32) -> Shape {
    let corner = |side: u32, at: Vec2, normal: Vec2| {
        let around = on_circle(f64::from(side % sides) / f64::from(sides));
        let turned = |v: Vec2| Vec3::new(v.x * around.x, v.y, v.x * -around.y);
        // On the axis, all sides share one point with one normal.
        let normal = if at.x == 0.0 { Vec3::Y * normal.y.signum() } else { turned(normal) };
        Vertex::new(turned(at), normal.normalize())
    };
    let mut shape = Shape::default();
    for side in 0..sides {
        let first = shape.vertices.len() as u32;
        let [next, this] = [side + 1, side];
        shape.vertices.extend([
            corner(this, low, normals[0]),
            corner(next, low, normals[0]),
            corner(next, high, normals[1]),
            corner(this, high, normals[1]),
        ]);
        // A band that begins or ends on the axis has one triangle per side.
        if low.x > 0.0 {
            shape.triangles.push([first, first + 1, first + 2]);
        }
        if high.x > 0.0 {
            shape.triangles.push([first, first + 2, first + 3]);
        }
    }
    shape
}

/// Returns a sphere about the origin.
pub(super) fn sphere(radius: f32, sides: u32, bands: u32) -> Shape {
    let point = |band: u32| match on_circle(f64::from(band) / f64::from(2 * bands)) {
        // The poles lie exactly on the axis.
        _ if band == 0 => Vec2::new(0.0, -radius),
        _ if band == bands => Vec2::new(0.0, radius),
        at => Vec2::new(at.y, -at.x) * radius,
    };
    lathe(&(0..=bands).map(point).collect::<Vec<_>>(), sides)
}

/// Returns a torus about the origin.
pub(super) fn torus(radius: f32, tube_radius: f32, sides: u32, tube_sides: u32) -> Shape {
    let point = |side: u32| {
        let at = on_circle(f64::from(side % tube_sides) / f64::from(tube_sides));
        Vec2::new(radius + tube_radius * at.x, tube_radius * at.y)
    };
    let mut torus = Shape::default();
    for side in 0..tube_sides {
        let normal = |side: u32| on_circle(f64::from(side % tube_sides) / f64::from(tube_sides));
        torus = torus.join(ring([point(side), point(side + 1)], [normal(side), normal(side + 1)], sides));
    }
    torus
}

/// Returns a regular prism without a bottom, twisted by the share `twist` of a turn between its foot at the origin and
/// its top, with flat faces.
pub(super) fn twisted_prism(radius: f32, height: f32, twist: f64, sides: u32, layers: u32) -> Shape {
    let corner = |side: u32, layer: u32| {
        let up = f64::from(layer) / f64::from(layers);
        let at = on_circle(f64::from(side % sides) / f64::from(sides) + twist * up) * radius;
        Vec3::new(at.x, height * up as f32, -at.y)
    };
    let mut prism = polygon(&(0..sides).map(|side| corner(side, layers)).collect::<Vec<_>>());
    for (layer, side) in (0..layers).flat_map(|layer| (0..sides).map(move |side| (layer, side))) {
        let [a, b] = [corner(side, layer), corner(side + 1, layer)];
        let [c, d] = [corner(side + 1, layer + 1), corner(side, layer + 1)];
        prism = prism.join(polygon(&[a, b, d])).join(polygon(&[b, c, d]));
    }
    prism
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::edge_cross;

    /// Enclosed volume by the divergence theorem; negative if the faces are directed inward.
    fn volume(shape: &Shape) -> f32 {
        let tetrahedron = |corners: &[u32; 3]| {
            let corners = corners.map(|v| shape.vertices[v as usize].position);
            corners[0].dot(edge_cross(corners)) / 6.0
        };
        shape.triangles.iter().map(tetrahedron).sum()
    }

    fn assert_normals_agree_with_faces(shape: &Shape) {
        for corners in &shape.triangles {
            let face = edge_cross(corners.map(|v| shape.vertices[v as usize].position)).normalize();
            for &v in corners {
                assert!(face.dot(shape.vertices[v as usize].normal) > 0.6);
            }
        }
    }

    #[test]
    fn closed_round_shapes_enclose_their_volume() {
        let pi = std::f32::consts::PI;
        for (shape, exact) in [
            (sphere(0.5, 64, 32), pi / 6.0),
            (torus(1.0, 0.25, 64, 32), 2.0 * pi * pi * 0.0625),
            (lathe(&[(0.0, 0.0), (1.0, 0.0), (1.0, 2.0), (0.0, 2.0)].map(Vec2::from), 128), 2.0 * pi),
            (twisted_prism(1.0, 3.0, 0.0, 4, 2), 6.0),
        ] {
            assert!((volume(&shape) / exact - 1.0).abs() < 0.02, "{} is not {exact}", volume(&shape));
            assert_normals_agree_with_faces(&shape);
        }
    }

    #[test]
    fn a_sphere_is_smooth_and_a_cylinder_has_creases() {
        for vertex in &sphere(2.0, 16, 8).vertices {
            assert!((vertex.normal - vertex.position / 2.0).length() < 0.03);
        }
        let cylinder = lathe(&[(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(Vec2::from), 16);
        assert!(cylinder.vertices.iter().all(|v| v.normal.y == 0.0 || v.normal.y == 1.0));
    }
}
