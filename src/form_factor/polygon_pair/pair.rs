//! The form factor of a pair of polygons in closed form: contour integrals, less what a blocker hides.

use std::f64::consts::TAU;

use glam::DVec3;

use super::contour::polygon_to_polygon;
use super::polygon::{Plane, Polygon};
use super::quadrature::integrate_triangle;

/// Two polygons that exchange light, and one that may stand between. The two emit and receive on their fronts; the
/// blocker blocks from both sides.
#[derive(Clone, Debug)]
pub struct PolygonPair {
    /// The polygon that light leaves.
    pub a: Polygon,
    /// The polygon at which it arrives.
    pub b: Polygon,
    /// The polygon in between.
    pub blocker: Option<Polygon>,
}

/// A form factor and its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// F from A to B, 0..1.
    pub factor: f64,
    /// Its standard error; for closed forms the error bound of the quadrature.
    pub error: f64,
}

/// Absolute error of the closed form behind a blocker.
const TOLERANCE: f64 = 1e-8;

impl PolygonPair {
    /// The form factor, exact except for the error of the quadrature.
    ///
    /// ```
    /// use hemicube::form_factor::polygon_pair::{Polygon, PolygonPair};
    ///
    /// let square = |corners: [[f64; 3]; 4]| Polygon::new(corners.map(Into::into).to_vec());
    /// let floor = square([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]])?;
    /// let ceiling = square([[0., 1., 1.], [1., 1., 1.], [1., 0., 1.], [0., 0., 1.]])?;
    /// let estimate = PolygonPair { a: floor, b: ceiling, blocker: None }.analytic();
    /// assert!((estimate.factor - 0.199_825).abs() < 1e-6);
    /// # Ok::<(), hemicube::form_factor::polygon_pair::PolygonError>(())
    /// ```
    ///
    /// Equation: F = F(A, B) - 1/A x integral over A of the point-to-polygon form factor of the part of B in the
    /// blocker's shadow.
    #[must_use]
    pub fn analytic(&self) -> Estimate {
        let open = polygon_to_polygon(&self.a, &self.b);
        let (hidden, error) = self.hidden().unwrap_or((0.0, 1e-8));
        Estimate { factor: (open - hidden).clamp(0.0, 1.0), error }
    }

    /// The form factor that the blocker hides, and its error; `None` if it hides nothing.
    fn hidden(&self) -> Option<(f64, f64)> {
        let (a, b) = (self.a.within(&self.b.plane())?, self.b.within(&self.a.plane())?);
        // Only the part of the blocker in front of both polygons stands between them.
        let blocker = self.blocker.as_ref()?.within(&self.a.plane())?.within(&self.b.plane())?;
        let normal = self.a.normal();
        let from_point =
            |point: DVec3| shadow(point, &blocker, &b).map_or(0.0, |part| point_to_polygon(point, normal, &part));
        let corners = a.corners();
        let tolerance = TOLERANCE * self.a.area() / (corners.len() - 2) as f64;
        let triangles = (1..corners.len() - 1).map(|i| [corners[0], corners[i], corners[i + 1]]);
        let (sum, error) = triangles
            .map(|triangle| integrate_triangle(&from_point, triangle, tolerance))
            .fold((0.0, 0.0), |whole, part| (whole.0 + part.0, whole.1 + part.1));
        Some((sum / self.a.area(), error / self.a.area()))
    }
}

/// The part of `b` that lies in the shadow of `blocker` from `point`.
fn shadow(point: DVec3, blocker: &Polygon, b: &Polygon) -> Option<Polygon> {
    let inside = blocker.centre() - point;
    let mut part = b.clone();
    for (start, end) in blocker.edges() {
        let normal = (start - point).cross(end - point).try_normalize()?;
        let normal = if normal.dot(inside) < 0.0 { -normal } else { normal };
        part = part.within(&Plane { normal, point })?;
    }
    Some(part)
}

/// Form factor from a differential area to a polygon above its horizon, in double precision (Lambert 1760).
fn point_to_polygon(point: DVec3, normal: DVec3, polygon: &Polygon) -> f64 {
    let term = |(a, b): (DVec3, DVec3)| {
        let (a, b) = (a - point, b - point);
        let cross = a.cross(b);
        let length = cross.length();
        if length > 0.0 { length.atan2(a.dot(b)) * normal.dot(cross) / length } else { 0.0 }
    };
    (polygon.edges().map(term).sum::<f64>() / TAU).abs()
}
