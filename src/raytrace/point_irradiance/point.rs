//! Points at which irradiance is measured, and the surfaces they lie on.

use glam::Vec3;

use crate::raytrace::path::ray_caster::RayCaster;
use crate::scene::normal_of;
use crate::trace::Hit;

/// Largest distance between a point and its surface, as a share of the scene's extent.
const REACH: f32 = 1e-4;

/// A point at which irradiance is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuringPoint {
    /// Position on a surface or in open space, metres.
    pub position: Vec3,
    /// Normal of the measuring plane, of any length.
    pub normal: Vec3,
}

/// A measuring point just above its surface.
pub(crate) struct PointOnSurface {
    pub origin: Vec3,
    /// Unit normal of the measuring plane.
    pub normal: Vec3,
    /// Unit normal of the surface, on the side of the measuring plane.
    pub geometric: Vec3,
}

impl PointOnSurface {
    pub(crate) fn of(rays: &RayCaster<'_>, point: &MeasuringPoint) -> Self {
        let normal = point.normal.normalize();
        let geometric = surface_at(rays, point).map_or(normal, |hit| {
            let front = normal_of(rays.scene().corners(hit.triangle));
            if front.dot(normal) < 0.0 { -front } else { front }
        });
        Self { origin: rays.above(point.position, geometric), normal, geometric }
    }
}

/// The surface that a point lies on.
pub(crate) fn surface_at(rays: &RayCaster<'_>, point: &MeasuringPoint) -> Option<Hit> {
    let reach = REACH * rays.scene().bounds().extent();
    let normal = point.normal.normalize();
    rays.tracer.nearest(point.position + normal * reach, -normal, 2.0 * reach)
}
