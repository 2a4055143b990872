//! Lights without effect.

use glam::Vec3;

use super::finding::{Finding, FindingKind, Location};
use crate::base::ids::TriangleId;
use crate::scene::{Light, LightKind, Scene};

/// Largest number of pairs of light and triangle that are tested; a scene with more pairs is not tested at all.
const MAX_PAIRS: usize = 200_000_000;

/// Finds lights whose range and cone contain no surface, and emissive materials that no triangle uses.
///
/// The test is conservative: a triangle is replaced by a sphere around it, so every reported light is without effect.
pub(super) fn without_effect(scene: &Scene) -> Finding {
    let is_affordable = scene.lights.len().saturating_mul(scene.triangles.len()) <= MAX_PAIRS;
    let idle = scene.lights.iter().filter(|light| is_affordable && !reaches_anything(light, scene));
    let idle: Vec<&Light> = idle.collect();
    let mut is_used = vec![false; scene.materials.len()];
    for triangle in &scene.triangles {
        is_used[triangle.material.index()] = true;
    }
    let unused = scene.materials.iter().zip(is_used).filter(|(material, used)| material.is_emissive() && !used);
    let names: Vec<_> =
        idle.iter().map(|light| light.name.as_str()).chain(unused.map(|(m, _)| m.name.as_str())).collect();
    let mut finding = Finding { count: names.len(), ..Finding::new(FindingKind::LightWithoutEffect) };
    finding.detail = names.join(", ");
    finding.show(idle.iter().filter_map(|light| position(light)).map(|at| Location::segment([at; 2])));
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
