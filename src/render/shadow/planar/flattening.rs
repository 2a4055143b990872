//! Projection of casters on to a plane (Blinn 1988).
//!
//! The projection is computed in double precision, and in the same way for both triangles at an edge. Therefore no
//! light leaks through at the places where casters are clipped.

use glam::{DMat4, DVec3, DVec4, Vec3, Vec4};

use super::settings::PlanarSettings;
use crate::render::shadow::shared::casters::{Caster, Casters};

/// Returns Blinn's matrix, which projects points on to `plane` away from a light at the homogeneous position `light`:
///
/// ```text
/// M = (P . L) I - L P^T
/// ```
///
/// For a point on the plane, P . M v = (P . L)(P . v) - (P . L)(P . v) = 0.
#[must_use]
pub fn flattening(plane: DVec4, light: DVec4) -> DMat4 {
    let outer = DMat4::from_cols(light * plane.x, light * plane.y, light * plane.z, light * plane.w);
    DMat4::from_diagonal(DVec4::splat(plane.dot(light))) - outer
}

/// Projects casters on to a plane. Returns three homogeneous corners for each triangle, with w > 0 if casters are
/// clipped. A caster within `clearance` of the plane (metres) counts as part of it and throws no shadow.
#[must_use]
pub fn flattened(casters: &Casters, plane: Vec4, light: Vec4, settings: &PlanarSettings, clearance: f32) -> Vec<Vec4> {
    let (plane, light, clearance) = (plane.as_dvec4(), light.as_dvec4(), f64::from(clearance));
    let matrix = flattening(plane, light);
    let exact_height = |corner: DVec3| plane.dot(corner.extend(1.0));
    let height = |corner: DVec3| if exact_height(corner).abs() <= clearance { 0.0 } else { exact_height(corner) };
    // A corner on the plane keeps its exact position. The foot of a wall is the edge of its floor, and rasterisation
    // assigns each pixel to one side of an edge only if both sides have equal corners.
    let flat = |corner: DVec3| match height(corner) {
        0.0 => corner.as_vec3().extend(1.0),
        _ => (matrix * corner.extend(1.0)).as_vec4(),
    };
    let ceiling = if light.w == 0.0 { f64::INFINITY } else { plane.dot(light) - clearance };
    let mut corners = Vec::new();
    let is_chosen = |triangle: &&Caster| settings.casters.is_empty() || settings.casters.contains(&triangle.instance);
    for triangle in casters.triangles.iter().filter(is_chosen) {
        let polygon = casters.corners(triangle).map(Vec3::as_dvec3);
        if !settings.clips_casters {
            corners.extend(polygon.map(flat));
            continue;
        }
        if polygon.iter().all(|&corner| height(corner) <= 0.0) {
            continue;
        }
        let above = clip(&polygon, height);
        let between = if ceiling.is_finite() { clip(&above, |corner| ceiling - height(corner)) } else { above };
        for i in 2..between.len() {
            corners.extend([0, i - 1, i].map(|corner| flat(between[corner])));
        }
    }
    corners
}

/// Returns the part of a convex polygon where `inside` is not negative (Sutherland and Hodgman 1974, "Reentrant polygon
/// clipping").
fn clip(polygon: &[DVec3], inside: impl Fn(DVec3) -> f64) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, &this) in polygon.iter().enumerate() {
        let next = polygon[(i + 1) % polygon.len()];
        if inside(this) >= 0.0 {
            kept.push(this);
        }
        if (inside(this) >= 0.0) != (inside(next) >= 0.0) {
            // Always interpolates from the inner end to the outer one, so that both triangles at an edge compute the
            // same point.
            let [from, to] = if inside(this) >= 0.0 { [this, next] } else { [next, this] };
            kept.push(from.lerp(to, inside(from) / (inside(from) - inside(to))));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::ids::InstanceId;

    const FLOOR: DVec4 = DVec4::Y;

    #[test]
    fn a_point_is_projected_along_the_line_from_the_light() {
        let light = DVec4::new(0.0, 4.0, 0.0, 1.0);
        let flat = (flattening(FLOOR, light) * DVec4::new(1.0, 2.0, 0.5, 1.0)).to_array();
        assert!(
            (flat[0] / flat[3] - 2.0).abs() < 1e-6 && flat[1].abs() < 1e-6 && (flat[2] / flat[3] - 1.0).abs() < 1e-6
        );
        let sun = DVec4::new(0.6, 0.8, 0.0, 0.0);
        let flat = (flattening(FLOOR, sun) * DVec4::new(1.0, 2.0, 0.5, 1.0)).to_array();
        assert!((flat[0] / flat[3] + 0.5).abs() < 1e-6, "{flat:?}");
    }

    #[test]
    fn casters_are_clipped_at_the_plane_and_below_the_light() {
        let positions = vec![Vec3::new(0.0, -1.0, 0.0), Vec3::new(1.0, 9.0, 0.0), Vec3::new(0.0, 9.0, 1.0)];
        let triangle = Caster {
            corners: [0, 1, 2],
            parts: 0..0,
            normals: [Vec3::Y; 3],
            is_single_sided: false,
            instance: InstanceId(0),
        };
        let casters = Casters { positions, triangles: vec![triangle], ..Casters::default() };
        let light = Vec4::new(0.0, 4.0, 0.0, 1.0);
        let cured = PlanarSettings::default();
        let cut = flattened(&casters, Vec4::Y, light, &cured, 1e-3);
        assert_eq!(cut.len(), 6, "a quadrilateral");
        assert!(cut.iter().all(|corner| corner.w > 0.0));
        let uncut = PlanarSettings { clips_casters: false, ..cured };
        assert!(flattened(&casters, Vec4::Y, light, &uncut, 1e-3).iter().any(|corner| corner.w < 0.0));
    }

    #[test]
    fn the_foot_of_a_wall_keeps_its_position() {
        // Coordinates that rounding would change in any multiplication.
        let foot = [Vec3::new(0.1, 0.0, -1.3), Vec3::new(0.1, 1e-7, 1.7)];
        let positions = vec![foot[0], foot[1], Vec3::new(0.1, 2.0, 0.3)];
        let triangle = Caster {
            corners: [0, 1, 2],
            parts: 0..0,
            normals: [Vec3::NEG_X; 3],
            is_single_sided: false,
            instance: InstanceId(0),
        };
        let casters = Casters { positions, triangles: vec![triangle], ..Casters::default() };
        let light = Vec4::new(-2.0, 4.1, 0.0, 1.0);
        let shadow = flattened(&casters, Vec4::Y, light, &PlanarSettings::default(), 1e-3);
        assert!(foot.iter().all(|corner| shadow.contains(&corner.extend(1.0))), "{shadow:?}");
    }
}
