//! A pair of polygons, and an estimate of its form factor.

use super::polygon::Polygon;

/// Two polygons that exchange light, and one that may stand between. The two emit and receive on their fronts; the blocker
/// blocks from both sides.
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
