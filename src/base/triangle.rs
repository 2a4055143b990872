//! Points of triangles: barycentric coordinates, interpolation, the closest point.

use std::ops::{Add, Mul};

use glam::Vec3;

/// Returns the point of a triangle that is nearest to `p`.
///
/// Source: Ericson 2005, "Real-Time Collision Detection", 5.1.5 (Voronoi regions of corners and edges).
#[must_use]
pub fn closest_point([a, b, c]: [Vec3; 3], p: Vec3) -> Vec3 {
    let (ab, ac) = (b - a, c - a);
    let (d1, d2) = (ab.dot(p - a), ac.dot(p - a));
    let (d3, d4) = (ab.dot(p - b), ac.dot(p - b));
    let (d5, d6) = (ab.dot(p - c), ac.dot(p - c));
    let (va, vb, vc) = (d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2);
    if d1 <= 0.0 && d2 <= 0.0 {
        a
    } else if d3 >= 0.0 && d4 <= d3 {
        b
    } else if d6 >= 0.0 && d5 <= d6 {
        c
    } else if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        a + ab * (d1 / (d1 - d3))
    } else if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        a + ac * (d2 / (d2 - d6))
    } else if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)))
    } else {
        (a * va + b * vb + c * vc) / (va + vb + vc)
    }
}

/// Returns the value at the point of a triangle with barycentric coordinates `weights`, interpolated linearly between
/// the values at its corners.
#[must_use]
pub fn interpolate<T>([a, b, c]: [T; 3], weights: Vec3) -> T
where
    T: Mul<f32, Output = T> + Add<Output = T>,
{
    a * weights.x + b * weights.y + c * weights.z
}

/// Returns the barycentric coordinates of a point in the plane of a triangle; those of the centroid if the triangle has
/// no area.
#[must_use]
pub fn barycentric([a, b, c]: [Vec3; 3], p: Vec3) -> Vec3 {
    let normal = (b - a).cross(c - a);
    let of = |from: Vec3, to: Vec3| (to - from).cross(p - from).dot(normal) / normal.length_squared();
    let weights = Vec3::new(of(b, c), of(c, a), of(a, b));
    if weights.is_finite() { weights } else { Vec3::splat(1.0 / 3.0) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::sampling::{r2, triangle_from_square};

    #[test]
    fn no_sampled_point_is_nearer_than_the_closest_point() {
        let corners = [Vec3::new(0.0, 0.0, 0.0), Vec3::new(2.0, 0.3, 0.0), Vec3::new(0.5, 1.5, 0.7)];
        for i in 0..200 {
            let (xy, z) = (r2(i, 3), r2(i, 4).x);
            let p = Vec3::new(xy.x * 5.0 - 2.0, xy.y * 5.0 - 2.0, z * 4.0 - 2.0);
            let nearest = closest_point(corners, p);
            for j in 0..400 {
                let w = triangle_from_square(r2(j, 5));
                let sample = interpolate(corners, w);
                assert!(nearest.distance(p) <= sample.distance(p) + 1e-4, "{p}: {nearest} but {sample}");
            }
        }
    }
}
