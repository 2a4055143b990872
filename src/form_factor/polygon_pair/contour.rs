//! Form factor between two polygons by contour integrals: exact without occlusion.
//!
//! Stokes' theorem, applied twice, turns the double area integral of the form factor into a double integral along both
//! outlines: F_AB = 1 / (2 pi A) x the contour integral over both boundaries of ln r dr_A . dr_B. Along one edge it has
//! a closed form; along the other it is integrated adaptively, from break point to break point, because its slope is
//! infinite at points where edges touch.
//!
//! Sources: Sparrow 1963, "A New and Simpler Formulation for Radiative Angle Factors"; Schröder, Hanrahan 1993, "On the
//! Form Factor between Two Polygons"; Mazumder, Ravishankar 2012 (edges in common).

use std::f64::consts::TAU;

use glam::DVec3;

use super::polygon::Polygon;
use super::quadrature::integrate;

/// Form factor from the front of `a` to the front of `b`.
///
/// The parts behind the plane of the other polygon do not count.
///
/// Equation: F = 1 / (2 pi A) x the sum over pairs of edges of the double integral of ln r along both, times the cosine
/// between them.
///
/// Accuracy: about 1e-8 absolute.
#[must_use]
pub fn polygon_to_polygon(a: &Polygon, b: &Polygon) -> f64 {
    let (Some(seen_a), Some(seen_b)) = (a.within(&b.plane()), b.within(&a.plane())) else {
        return 0.0;
    };
    // Rescale to units in which logarithms are small.
    let unit = seen_a.size().max(seen_b.size());
    let centre = seen_a.centre();
    let (seen_a, seen_b) = (seen_a.rescaled(centre, 1.0 / unit), seen_b.rescaled(centre, 1.0 / unit));
    let tolerance = 1e-9 * seen_a.area().min(seen_b.area());
    let sum: f64 = seen_a
        .edges()
        .flat_map(|edge_a| seen_b.edges().map(move |edge_b| (edge_a, edge_b)))
        .map(|(edge_a, edge_b)| edge_pair(edge_a, edge_b, tolerance))
        .sum();
    (sum * unit * unit / (TAU * a.area())).clamp(0.0, 1.0)
}

/// Integral of ln r along two edges, times the cosine between them.
fn edge_pair((a, a_end): (DVec3, DVec3), (b, b_end): (DVec3, DVec3), tolerance: f64) -> f64 {
    let (along_a, along_b) = (a_end - a, b_end - b);
    let (length_a, length_b) = (along_a.length(), along_b.length());
    let (along_a, along_b) = (along_a / length_a, along_b / length_b);
    let cosine = along_a.dot(along_b);
    if cosine.abs() < 1e-15 {
        return 0.0;
    }
    // The integrand has kinks at the points closest to the ends of the other edge and to its line.
    let foot = |point: DVec3| along_a.dot(point - a);
    let across = 1.0 - cosine * cosine;
    let crossing = if across > 1e-12 { (foot(b) - cosine * along_b.dot(b - a)) / across } else { 0.0 };
    let mut breaks = [0.0, foot(b), foot(b_end), crossing, length_a].map(|s| s.clamp(0.0, length_a));
    breaks.sort_by(f64::total_cmp);
    let inner = |s: f64| log_distance(a + along_a * s - b, along_b, length_b);
    cosine * breaks.windows(2).map(|pair| integrate(&inner, pair[0], pair[1], tolerance)).sum::<f64>()
}

/// Integral along an edge of the logarithm of the distance to a point; `offset` is the vector from the edge's start to
/// the point.
fn log_distance(offset: DVec3, along: DVec3, length: f64) -> f64 {
    let foot = offset.dot(along);
    let height = (offset - foot * along).length();
    let antiderivative = |u: f64| {
        let squared = u * u + height * height;
        if squared == 0.0 { 0.0 } else { 0.5 * u * squared.ln() - u + height * u.atan2(height) }
    };
    antiderivative(length - foot) - antiderivative(-foot)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(corners: &[[f64; 3]]) -> Polygon {
        Polygon::new(corners.iter().map(|&corner| DVec3::from(corner)).collect()).expect("a polygon")
    }

    fn floor() -> Polygon {
        polygon(&[[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]])
    }

    #[test]
    fn squares_have_the_published_form_factors() {
        let ceiling = polygon(&[[0., 1., 1.], [1., 1., 1.], [1., 0., 1.], [0., 0., 1.]]);
        assert!((polygon_to_polygon(&floor(), &ceiling) - 0.199_824_895_698_387).abs() < 1e-9);
        let wall = polygon(&[[0., 0., 0.], [0., 1., 0.], [0., 1., 1.], [0., 0., 1.]]);
        assert!((polygon_to_polygon(&floor(), &wall) - 0.200_043_776_075_404).abs() < 1e-9);
    }

    #[test]
    fn polygons_that_face_away_or_lie_behind_have_no_form_factor() {
        let away = polygon(&[[0., 0., 1.], [1., 0., 1.], [1., 1., 1.], [0., 1., 1.]]);
        assert_eq!(polygon_to_polygon(&floor(), &away), 0.0);
        let below = polygon(&[[0., 1., -1.], [1., 1., -1.], [1., 0., -1.], [0., 0., -1.]]);
        assert_eq!(polygon_to_polygon(&floor(), &below), 0.0);
    }

    #[test]
    fn form_factors_are_reciprocal() {
        let speck = polygon(&[[0.4, 0.5, 0.3], [0.4, 0.5001, 0.3], [0.4001, 0.5001, 0.3002]]);
        let (there, back) = (polygon_to_polygon(&floor(), &speck), polygon_to_polygon(&speck, &floor()));
        assert!((there * floor().area() / (back * speck.area()) - 1.0).abs() < 1e-6, "{there} {back}");
    }
}
