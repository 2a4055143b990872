//! Receivers of planar shadows: the largest or the chosen planes of a scene.

use std::collections::HashMap;

use glam::Vec4;

use super::planes::{SAME_DISTANCE, SAME_NORMAL, is_same_plane, plane_of};
use super::settings::PlanarSettings;
use crate::base::ids::TriangleId;
use crate::scene::{AlphaMode, Scene, area_of};

/// A plane that receives shadows.
#[derive(Clone, Debug, PartialEq)]
pub struct Receiver {
    /// Unit normal n and distance w: n . p + w = 0.
    pub plane: Vec4,
    /// Triangles that lie in the plane.
    pub triangles: Vec<TriangleId>,
    /// Total area of these triangles, square metres.
    pub area: f32,
}

/// Returns the planes of a scene that receive shadows: the chosen planes, or those with the largest area if none is
/// chosen.
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

/// Returns all planes of a scene, the largest first.
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
