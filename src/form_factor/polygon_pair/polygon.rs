//! Convex, planar polygons in double precision, for exact form factors.

use glam::DVec3;
use thiserror::Error;

/// Distance from a plane that counts as on it, as a share of the polygon's size.
const FLATNESS: f64 = 1e-6;

/// A convex, planar polygon. Its front is the side from which its corners run counter-clockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    corners: Vec<DVec3>,
    normal: DVec3,
    area: f64,
}

/// The corners form no convex, planar polygon.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum PolygonError {
    /// Fewer than three different corners.
    #[error("a polygon needs three different corners or more")]
    TooFewCorners,
    /// A coordinate is infinite or NaN.
    #[error("a coordinate is not finite")]
    NotFinite,
    /// All corners lie on a line.
    #[error("its corners lie on a line")]
    NoArea,
    /// A corner lies off the plane of the others.
    #[error("it is not planar")]
    NotPlanar,
    /// It has a notch, or edges that cross.
    #[error("it is not convex")]
    NotConvex,
}

/// A plane and the half space in front of it: the points whose signed distance is not negative.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    /// Unit normal towards the half space.
    pub normal: DVec3,
    /// A point on the plane.
    pub point: DVec3,
}

impl Plane {
    /// Signed distance of a point from the plane, metres.
    #[must_use]
    pub fn distance(&self, point: DVec3) -> f64 {
        self.normal.dot(point - self.point)
    }
}

impl Polygon {
    /// Creates a polygon with the given corners.
    ///
    /// # Errors
    /// Returns an error if the corners form no convex, planar polygon.
    pub fn new(mut corners: Vec<DVec3>) -> Result<Self, PolygonError> {
        if !corners.iter().all(|corner| corner.is_finite()) {
            return Err(PolygonError::NotFinite);
        }
        corners.dedup();
        while corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        if corners.len() < 3 {
            return Err(PolygonError::TooFewCorners);
        }
        let polygon = Self::measured(corners);
        let size = polygon.size();
        if polygon.area <= 1e-14 * size * size {
            return Err(PolygonError::NoArea);
        }
        let plane = polygon.plane();
        if polygon.corners.iter().any(|&corner| plane.distance(corner).abs() > FLATNESS * size) {
            return Err(PolygonError::NotPlanar);
        }
        if !polygon.is_convex() {
            return Err(PolygonError::NotConvex);
        }
        Ok(polygon)
    }

    /// Computes area and normal by Newell's sum.
    fn measured(corners: Vec<DVec3>) -> Self {
        let first = corners[0];
        let twice: DVec3 = corners.windows(2).map(|pair| (pair[0] - first).cross(pair[1] - first)).sum();
        Self { normal: twice.normalize_or_zero(), area: 0.5 * twice.length(), corners }
    }

    /// Returns true if every turn is to the left and the turns add up to one revolution.
    fn is_convex(&self) -> bool {
        let edges: Vec<DVec3> = self.edges().map(|(a, b)| (b - a).normalize()).collect();
        let mut whole = 0.0;
        for (i, edge) in edges.iter().enumerate() {
            let next = edges[(i + 1) % edges.len()];
            let (sin, cos) = (self.normal.dot(edge.cross(next)), edge.dot(next));
            if sin < -FLATNESS {
                return false;
            }
            whole += sin.max(0.0).atan2(cos);
        }
        whole < 1.5 * std::f64::consts::TAU
    }

    /// Corners, counter-clockwise from the front.
    #[must_use]
    pub fn corners(&self) -> &[DVec3] {
        &self.corners
    }

    /// Edges in order, from corner to corner.
    pub fn edges(&self) -> impl Iterator<Item = (DVec3, DVec3)> {
        (0..self.corners.len()).map(|i| (self.corners[i], self.corners[(i + 1) % self.corners.len()]))
    }

    /// Unit normal of the front.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// Area, square metres.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.area
    }

    /// Mean of the corners.
    #[must_use]
    pub fn centre(&self) -> DVec3 {
        self.corners.iter().sum::<DVec3>() / self.corners.len() as f64
    }

    /// Largest distance of a corner from the centre, metres.
    #[must_use]
    pub fn size(&self) -> f64 {
        let centre = self.centre();
        self.corners.iter().map(|corner| corner.distance(centre)).fold(0.0, f64::max)
    }

    /// The plane of the polygon, with the half space in front of it.
    #[must_use]
    pub fn plane(&self) -> Plane {
        Plane { normal: self.normal, point: self.corners[0] }
    }

    /// Returns the polygon translated by `-centre`, then scaled.
    #[must_use]
    pub fn rescaled(&self, centre: DVec3, scale: f64) -> Self {
        let corners = self.corners.iter().map(|&corner| (corner - centre) * scale).collect();
        Self { corners, normal: self.normal, area: self.area * scale * scale }
    }

    /// Returns the part within a half space, or `None` if it has no area.
    #[must_use]
    pub fn within(&self, plane: &Plane) -> Option<Self> {
        let rounding = 1e-12 * self.size();
        let height = |point| {
            let distance = plane.distance(point);
            if distance.abs() <= rounding { 0.0 } else { distance }
        };
        let mut kept = Vec::with_capacity(self.corners.len() + 1);
        for (a, b) in self.edges() {
            let (height_a, height_b) = (height(a), height(b));
            if height_a >= 0.0 {
                kept.push(a);
            }
            if height_a * height_b < 0.0 {
                kept.push(a + (b - a) * (height_a / (height_a - height_b)));
            }
        }
        if kept.len() < 3 {
            return None;
        }
        let part = Self::measured(kept);
        (part.area > 1e-15 * self.area).then_some(Self { normal: self.normal, ..part })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(corners: &[[f64; 3]]) -> Result<Polygon, PolygonError> {
        Polygon::new(corners.iter().map(|&corner| DVec3::from(corner)).collect())
    }

    #[test]
    fn corners_that_form_no_polygon_are_refused() {
        let square = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];
        assert_eq!(polygon(&square).map(|p| (p.area(), p.normal())), Ok((1.0, DVec3::Z)));
        assert_eq!(polygon(&square[..2]), Err(PolygonError::TooFewCorners));
        assert_eq!(polygon(&[[0., 0., 0.], [1., 0., 0.], [2., 0., 0.]]), Err(PolygonError::NoArea));
        assert_eq!(polygon(&[square[0], square[1], square[2], [0., 1., 0.1]]), Err(PolygonError::NotPlanar));
        assert_eq!(polygon(&[square[0], square[2], square[1], square[3]]), Err(PolygonError::NoArea));
        let notched = [[0., 0., 0.], [2., 0., 0.], [0.5, 0.5, 0.], [0., 2., 0.]];
        assert_eq!(polygon(&notched), Err(PolygonError::NotConvex));
        assert_eq!(polygon(&[square[0], square[1], [f64::NAN, 1., 0.]]), Err(PolygonError::NotFinite));
    }

    #[test]
    fn a_half_space_clips_a_square() {
        let square = polygon(&[[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]]).expect("a square");
        let cut = |x| square.within(&Plane { normal: DVec3::X, point: DVec3::X * x }).map(|part| part.area());
        assert_eq!(cut(0.25), Some(0.75));
        assert_eq!(cut(0.0), Some(1.0));
        assert_eq!(cut(1.0), None);
    }
}
