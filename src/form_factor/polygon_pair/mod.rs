//! The form factor of a pair of polygons, with a third polygon that may stand between: by closed forms, rays or
//! hemicubes.

mod contour;
mod pair;
mod polygon;
mod quadrature;
mod sampled;

pub use contour::polygon_to_polygon;
pub use pair::{Estimate, PolygonPair};
pub use polygon::{Plane, Polygon, PolygonError};
