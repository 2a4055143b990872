//! Lights that light nothing.

use glam::Vec3;

use super::finding::{Finding, Kind, Place};
use crate::base::ids::TriangleId;
use crate::scene::{Light, LightKind, Scene};

/// Most pairs of light and triangle that are looked at; with more lights than that, none is doubted.
const MAX_PAIRS: usize = 200_000_000;

/// Lights whose range or cone no surface reaches into, and emissive materials that nothing wears.
///
/// Surfaces are taken as larger than they are (by the sphere round a triangle), so that no light is accused wrongly.
pub(super) fn without_effect(scene: &Scene) -> Finding {
    let is_affordable = scene.lights.len().saturating_mul(scene.triangles.len()) <= MAX_PAIRS;
    let doubted = scene.lights.iter().filter(|light| is_affordable && !reaches_anything(light, scene));
    let idle: Vec<&Light> = doubted.collect();
    let mut is_worn = vec![false; scene.materials.len()];
    for triangle in &scene.triangles {
        is_worn[triangle.material.index()] = true;
    }
    let unworn = scene.materials.iter().zip(is_worn).filter(|(material, worn)| material.is_emissive() && !worn);
    let names: Vec<_> =
        idle.iter().map(|light| light.name.as_str()).chain(unworn.map(|(m, _)| m.name.as_str())).collect();
    let mut finding = Finding { count: names.len(), ..Finding::new(Kind::LightWithoutEffect) };
    finding.detail = names.join(", ");
    finding.show(idle.iter().filter_map(|light| position(light)).map(|at| Place::segment([at; 2])));
    finding
}

fn position(light: &Light) -> Option<Vec3> {
    match light.kind {
        LightKind::Point { position } | LightKind::Spot { position, .. } => Some(position),
        LightKind::Directional { .. } => None,
    }
}

fn reaches_anything(light: &Light, scene: &Scene) -> bool {
    (0..scene.triangles.len()).any(|t| reaches(light, scene.corners(TriangleId::new(t))))
}

fn reaches(light: &Light, corners: [Vec3; 3]) -> bool {
    let centre = corners.iter().sum::<Vec3>() / 3.0;
    let radius = corners.map(|corner| corner.distance(centre)).into_iter().fold(0.0, f32::max);
    let Some(position) = position(light) else { return true };
    let distance = position.distance(centre);
    if light.range.is_some_and(|range| distance - radius > range) {
        return false;
    }
    let LightKind::Spot { direction, outer_angle, .. } = light.kind else { return true };
    let half_width = (radius / distance.max(f32::MIN_POSITIVE)).min(1.0).asin();
    distance <= radius || (centre - position).angle_between(direction) - half_width <= outer_angle
}
