//! Form factor from a point to a polygon in closed form, without occlusion: Lambert's contour integral.
//!
//! By Stokes' theorem the integral of cos theta_x cos theta_y / (pi r^2) over a polygon becomes an integral along its
//! outline. Each edge contributes the angle that it subtends times the cosine between the normal at the point and the
//! normal of the plane through the edge and the point.
//!
//! Source: Lambert 1760, "Photometria"; Baum, Rushmeier, Winget 1989, section 4 (the contour sum as used for
//! radiosity).

use std::f32::consts::TAU;

use glam::Vec3;

/// Form factor from a differential area at `point` with unit `normal` to a polygon of at most seven corners, whichever
/// way the polygon faces.
///
/// The part of the polygon below the horizon is clipped.
///
/// ```
/// use hemicube::glam::Vec3;
/// use hemicube::form_factor::point_to_polygon;
///
/// let far = 1e4;
/// let sky = [(-far, -far), (far, -far), (far, far), (-far, far)].map(|(x, y)| Vec3::new(x, y, 1.0));
/// assert!((point_to_polygon(Vec3::ZERO, Vec3::Z, &sky) - 1.0).abs() < 1e-4);
/// ```
///
/// Equation: F = 1 / (2 pi) x |sum over edges of angle_k x (normal . unit(a_k x b_k))|.
///
/// Accuracy: about 1e-6 absolute, rounding only.
#[must_use]
pub fn point_to_polygon(point: Vec3, normal: Vec3, polygon: &[Vec3]) -> f32 {
    let mut sum = 0.0;
    let mut above = ClippedPolygon::default();
    above.clip(point, normal, polygon);
    let corners = above.corners();
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        let cross = a.cross(b);
        let length = cross.length();
        // Corners in the same direction subtend no angle.
        if length > 0.0 {
            sum += length.atan2(a.dot(b)) * normal.dot(cross) / length;
        }
    }
    (sum.abs() / TAU).min(1.0)
}

/// The part of a polygon above the horizon, relative to the point.
///
/// Clipping a convex polygon of n corners by a plane leaves at most n + 1.
#[derive(Default)]
struct ClippedPolygon {
    corners: [Vec3; 8],
    len: usize,
}

impl ClippedPolygon {
    fn clip(&mut self, point: Vec3, normal: Vec3, polygon: &[Vec3]) {
        debug_assert!(polygon.len() < self.corners.len(), "polygons have at most seven corners");
        for (i, &corner) in polygon.iter().enumerate() {
            let (a, b) = (corner - point, polygon[(i + 1) % polygon.len()] - point);
            let (height_a, height_b) = (normal.dot(a), normal.dot(b));
            if height_a >= 0.0 {
                self.push(a);
            }
            if (height_a > 0.0 && height_b < 0.0) || (height_a < 0.0 && height_b > 0.0) {
                self.push(a + (b - a) * (height_a / (height_a - height_b)));
            }
        }
    }

    fn push(&mut self, corner: Vec3) {
        self.corners[self.len] = corner;
        self.len += 1;
    }

    fn corners(&self) -> &[Vec3] {
        &self.corners[..self.len]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of side 2 a at distance `h` above the origin.
    fn square(a: f32, h: f32) -> [Vec3; 4] {
        [Vec3::new(-a, -a, h), Vec3::new(a, -a, h), Vec3::new(a, a, h), Vec3::new(-a, a, h)]
    }

    #[test]
    fn a_square_overhead_has_the_published_form_factor() {
        // Four corner rectangles: F = 4 / (2 pi) x 2 x x / sqrt(1 + x^2) x atan(x / sqrt(1 + x^2)) with x = a / h.
        let x: f32 = 0.7;
        let a = x.hypot(1.0);
        let exact = 4.0 / TAU * 2.0 * (x / a) * (x / a).atan();
        assert!((point_to_polygon(Vec3::ZERO, Vec3::Z, &square(0.7, 1.0)) - exact).abs() < 1e-6);
    }

    #[test]
    fn a_huge_square_overhead_fills_the_view() {
        assert!((point_to_polygon(Vec3::ZERO, Vec3::Z, &square(1e4, 1.0)) - 1.0).abs() < 1e-4);
    }

    #[test]
    fn the_part_below_the_horizon_is_clipped() {
        let upright = [
            Vec3::new(1.0, -1.0, -1.0),
            Vec3::new(1.0, 1.0, -1.0),
            Vec3::new(1.0, 1.0, 1.0),
            Vec3::new(1.0, -1.0, 1.0),
        ];
        let upper = [Vec3::new(1.0, -1.0, 0.0), Vec3::new(1.0, 1.0, 0.0), upright[2], upright[3]];
        let whole = point_to_polygon(Vec3::ZERO, Vec3::Z, &upright);
        assert!((whole - point_to_polygon(Vec3::ZERO, Vec3::Z, &upper)).abs() < 1e-6);
        assert_eq!(point_to_polygon(Vec3::ZERO, Vec3::Z, &square(1.0, -1.0)), 0.0);
    }
}
