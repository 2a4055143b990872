//! The visible point of a pixel, computed in double precision.

use glam::{DVec2, DVec3};

use super::pixel_rays::PixelRays;
use super::visible_points::VisiblePoint;
use crate::render::shadow::shared::exact_rays::{ExactRays, Line};

/// Distance of a ray's origin from its surface, as a share of the distance to the eye. It keeps surfaces that coincide
/// with the visible one from shadowing it.
const TOWARDS_EYE: f64 = 1e-5;
/// Upper bound of the distance by which rasterisation moves corners, pixels.
const SNAP: f64 = 1.0 / 128.0;
/// Offsets of the four additional lines from the middle of a pixel, in units of [`SNAP`].
const CORNERS: [DVec2; 4] = [DVec2::NEG_ONE, DVec2::new(1.0, -1.0), DVec2::new(-1.0, 1.0), DVec2::ONE];
/// Largest distance along a line between two estimates of one point, as a share of the distance from the eye.
const SAME_POINT: f64 = 1e-3;
/// Smallest cosine between a triangle's normal and the raster's shading normal at which the triangle is certainly the
/// one that the raster shows.
const CERTAIN: f64 = 0.9;

/// The origin of a pixel's shadow rays, and the surface that it lies on.
pub struct RayOrigin {
    /// Origin of the lines of sight, metres.
    pub origin: DVec3,
    /// The visible point according to the raster.
    pub visible: VisiblePoint,
    /// Corners of its triangle; `None` if the line through the pixel misses it by a rounding error.
    pub triangle: Option<[DVec3; 3]>,
}

impl RayOrigin {
    /// Finds the point of the triangle that the raster shows in a pixel.
    pub fn new(rays: &ExactRays, lines: &PixelRays, pixel: usize, visible: VisiblePoint) -> Self {
        let middle = lines.through(pixel, DVec2::ZERO);
        let hit = SurfaceHit::new(rays, lines, middle, &visible).filter(SurfaceHit::is_certain).or_else(|| {
            // The raster snaps corners to a fraction of a pixel. So at the edge of a triangle, the triangle
            // that it shows may differ from the one that the line through the middle hits.
            let beside = CORNERS.map(|corner| lines.through(pixel, SNAP * corner));
            let hits =
                [middle].into_iter().chain(beside).filter_map(|line| SurfaceHit::new(rays, lines, line, &visible));
            hits.max_by(|a, b| a.cosine.total_cmp(&b.cosine))
        });
        let point = hit.as_ref().map_or(visible.point.as_dvec3(), |hit| hit.point);
        let origin = point + TOWARDS_EYE * lines.towards_eye(point);
        Self { origin, visible, triangle: hit.map(|hit| hit.corners) }
    }
}

/// A triangle that may be the one that the raster shows.
struct SurfaceHit {
    point: DVec3,
    corners: [DVec3; 3],
    /// Cosine between its normal on the visible side and the normal that the raster shows.
    cosine: f64,
}

impl SurfaceHit {
    fn new(rays: &ExactRays, lines: &PixelRays, line: Line, visible: &VisiblePoint) -> Option<Self> {
        let expected = (visible.point.as_dvec3() - line.origin).dot(line.direction);
        let hit =
            rays.nearest_to(line, expected).filter(|hit| (hit.distance - expected).abs() <= SAME_POINT * expected)?;
        let (point, corners) = (line.origin + line.direction * hit.distance, rays.corners(hit.triangle));
        let normal = front_normal(corners).normalize_or_zero();
        let seen = if normal.dot(lines.towards_eye(point)) < 0.0 { -normal } else { normal };
        Some(Self { point, corners, cosine: seen.dot(visible.normal.as_dvec3()) })
    }

    /// Returns true if this is certainly the triangle that the raster shows.
    fn is_certain(&self) -> bool {
        self.cosine > CERTAIN
    }
}

/// Returns a normal of any length on the front side of a triangle.
pub fn front_normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}
