//! Planes that receive planar shadows, and casters flattened on to them.
//!
//! In double precision, and the same for both triangles at an edge: no light may slip through where casters are cut.

use std::collections::HashMap;

use glam::{DMat4, DVec3, DVec4, Vec3, Vec4};

use super::casters::{Caster, Casters};
use super::planar_shadow::PlanarSettings;
use crate::base::ids::TriangleId;
use crate::scene::{AlphaMode, Scene, area_of, normal_of};

/// Normals closer than this are one direction; distances by this share of the scene's extent are one plane.
const SAME_NORMAL: f32 = 1e-4;
const SAME_DISTANCE: f32 = 1e-5;

/// A plane that receives shadows.
#[derive(Clone, Debug, PartialEq)]
pub struct Receiver {
    /// Unit normal and distance: points with n . p + w = 0.
    pub plane: Vec4,
    /// Its triangles.
    pub triangles: Vec<TriangleId>,
    /// Square metres.
    pub area: f32,
}

/// Unit normal and distance of the plane of a triangle; none where it has no area.
#[must_use]
pub fn plane_of(scene: &Scene, id: TriangleId) -> Option<Vec4> {
    let corners = scene.corners(id);
    let normal = normal_of(corners);
    let distance = -normal.dot((corners[0] + corners[1] + corners[2]) / 3.0);
    (normal != Vec3::ZERO).then(|| normal.extend(distance))
}

/// Two planes that look alike, of a scene this large, metres.
#[must_use]
pub fn is_same_plane(a: Vec4, b: Vec4, extent: f32) -> bool {
    a.truncate().distance(b.truncate()) < 10.0 * SAME_NORMAL && (a.w - b.w).abs() < 100.0 * SAME_DISTANCE * extent
}

/// The planes of a scene that receive shadows: those that are chosen, else those on which most area lies.
#[must_use]
pub fn receivers(scene: &Scene, settings: &PlanarSettings) -> Vec<Receiver> {
    let mut planes = planes(scene);
    if settings.receivers.is_empty() {
        planes.truncate(settings.num_receivers);
    } else {
        let extent = scene.bounds().extent();
        planes.retain(|plane| settings.receivers.iter().any(|&chosen| is_same_plane(plane.plane, chosen, extent)));
    }
    planes
}

/// All planes of a scene, the largest first.
fn planes(scene: &Scene) -> Vec<Receiver> {
    let step = SAME_DISTANCE * scene.bounds().extent().max(f32::MIN_POSITIVE);
    let mut planes: HashMap<[i64; 4], Receiver> = HashMap::new();
    for t in 0..scene.triangles.len() {
        let id = TriangleId::new(t);
        let corners = scene.corners(id);
        let Some(plane) = plane_of(scene, id).filter(|_| scene.material_of(id).alpha_mode != AlphaMode::Blend) else {
            continue;
        };
        let [x, y, z] = plane.truncate().to_array().map(|n| (n / SAME_NORMAL).round() as i64);
        let key = [x, y, z, (plane.w / (10.0 * step)).round() as i64];
        let receiver = planes.entry(key).or_insert(Receiver { plane, triangles: Vec::new(), area: 0.0 });
        if corners.iter().any(|corner| receiver.plane.dot(corner.extend(1.0)).abs() > step) {
            continue;
        }
        receiver.triangles.push(id);
        receiver.area += area_of(corners);
    }
    let mut receivers: Vec<Receiver> = planes.into_values().collect();
    receivers.retain(|receiver| !receiver.triangles.is_empty());
    receivers.sort_by(|a, b| b.area.total_cmp(&a.area).then(a.triangles[0].cmp(&b.triangles[0])));
    receivers
}

/// Flattens on to `plane` as a light at the homogeneous `light` does.
///
/// Equation: M = (P . L) I - L P^T.
#[must_use]
pub fn flattening(plane: DVec4, light: DVec4) -> DMat4 {
    let outer = DMat4::from_cols(light * plane.x, light * plane.y, light * plane.z, light * plane.w);
    DMat4::from_diagonal(DVec4::splat(plane.dot(light))) - outer
}

/// Triangles flattened on to a plane, three homogeneous corners each, w > 0 where casters are clipped; those within `clearance` of
/// the plane lie in it and throw nothing.
#[must_use]
pub fn flattened(casters: &Casters, plane: Vec4, light: Vec4, settings: &PlanarSettings, clearance: f32) -> Vec<Vec4> {
    let (plane, light, clearance) = (plane.as_dvec4(), light.as_dvec4(), f64::from(clearance));
    let matrix = flattening(plane, light);
    let exact_height = |corner: DVec3| plane.dot(corner.extend(1.0));
    let height = |corner: DVec3| if exact_height(corner).abs() <= clearance { 0.0 } else { exact_height(corner) };
    // What stands on the plane stays where it is, to the last bit: the foot of a wall is the edge of its floor, and only
    // the same corners make an edge of which the raster gives each pixel to one side.
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

/// The part of a convex polygon where `inside` is not negative (Sutherland, Hodgman 1974).
fn clip(polygon: &[DVec3], inside: impl Fn(DVec3) -> f64) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, &this) in polygon.iter().enumerate() {
        let next = polygon[(i + 1) % polygon.len()];
        if inside(this) >= 0.0 {
            kept.push(this);
        }
        if (inside(this) >= 0.0) != (inside(next) >= 0.0) {
            // From the end inside to the end outside, whichever way round the polygon runs.
            let [from, to] = if inside(this) >= 0.0 { [this, next] } else { [next, this] };
            kept.push(from.lerp(to, inside(from) / (inside(from) - inside(to))));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLOOR: DVec4 = DVec4::Y;

    #[test]
    fn a_point_is_flattened_along_the_line_from_the_light() {
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
    fn casters_are_cut_at_the_plane_and_below_the_light() {
        let positions = vec![Vec3::new(0.0, -1.0, 0.0), Vec3::new(1.0, 9.0, 0.0), Vec3::new(0.0, 9.0, 1.0)];
        let triangle = super::super::casters::Caster {
            corners: [0, 1, 2],
            parts: 0..0,
            normals: [Vec3::Y; 3],
            is_single_sided: false,
            instance: crate::base::ids::InstanceId(0),
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
    fn the_foot_of_a_wall_stays_where_it_is() {
        // Coordinates that no product leaves alone.
        let foot = [Vec3::new(0.1, 0.0, -1.3), Vec3::new(0.1, 1e-7, 1.7)];
        let positions = vec![foot[0], foot[1], Vec3::new(0.1, 2.0, 0.3)];
        let triangle = super::super::casters::Caster {
            corners: [0, 1, 2],
            parts: 0..0,
            normals: [Vec3::NEG_X; 3],
            is_single_sided: false,
            instance: crate::base::ids::InstanceId(0),
        };
        let casters = Casters { positions, triangles: vec![triangle], ..Casters::default() };
        let light = Vec4::new(-2.0, 4.1, 0.0, 1.0);
        let shadow = flattened(&casters, Vec4::Y, light, &PlanarSettings::default(), 1e-3);
        assert!(foot.iter().all(|corner| shadow.contains(&corner.extend(1.0))), "{shadow:?}");
    }
}
