//! Marks over the picture: wire of elements or patches, selected instances, form factors, the shooting patch, advice.

use std::collections::HashMap;

use glam::Vec3;

use crate::base::ids::{InstanceId, PatchId, TriangleId};
use crate::render::{Mark, turbo};
use crate::scene::Scene;
use crate::scene::doctor::Location;
use crate::viewer::settings::view::Wire;
use crate::viewer::solution::solved::SolvedScene;

/// Lines of two corners and triangles of three corners each.
#[derive(Default)]
pub struct Marks {
    /// Corners of the lines.
    pub lines: Vec<Mark>,
    /// Corners of the tinted triangles.
    pub triangles: Vec<Mark>,
}

const WIRE: [u8; 4] = [20, 24, 30, 150];
const CHOSEN: [u8; 4] = [255, 176, 64, 90];
const SHOOTER: [u8; 4] = [255, 80, 60, 170];
const SHOOTER_EDGE: [u8; 4] = [255, 235, 120, 255];
const LOCATION: [u8; 4] = [255, 70, 200, 255];
/// Half the width of the cross that marks a point, metres.
const POINT_SIZE: f32 = 0.1;
/// Opacity of the heat map.
const HEAT_ALPHA: u8 = 225;
/// Colour of elements with a form factor of 0.
const UNSEEN: [u8; 4] = [24, 24, 28, 170];
/// Decades that the heat map spans.
const HEAT_DECADES: f32 = 3.0;

impl Marks {
    /// Adds the wireframe. That of patches requires a solved scene.
    pub fn wire(&mut self, wire: Wire, scene: &Scene, solved: Option<&SolvedScene>) {
        let patch_of = |t: usize| solved.and_then(|solved| solved.mesh.elements.get(t)).map(|element| element.patch);
        let part_of = |t: usize| match wire {
            Wire::Patches => patch_of(t).map(|patch| patch.index()),
            Wire::None | Wire::Elements => Some(t),
        };
        if wire != Wire::None {
            let all = (0..scene.triangles.len()).map(TriangleId::new);
            self.lines.extend(borders(scene, all, part_of).into_iter().flatten().map(|p| mark(p, WIRE)));
        }
    }

    /// Tints an instance.
    pub fn chosen(&mut self, scene: &Scene, instance: InstanceId) {
        let Some(instance) = scene.instances.get(instance.index()) else { return };
        for t in instance.triangles.clone().map(TriangleId::new).filter(|&t| !scene.sides.is_back(t)) {
            self.face(scene, t, CHOSEN);
        }
    }

    /// Tints every element by `heat` `[e]`, 0..1, on a logarithmic scale.
    pub fn heat(&mut self, scene: &Scene, heat: &[f32]) {
        for (e, &heat) in heat.iter().enumerate().take(scene.triangles.len()) {
            let place = 1.0 + heat.max(1e-9).log10() / HEAT_DECADES;
            let [r, g, b] = turbo(place);
            let colour = if heat > 0.0 { [r, g, b, HEAT_ALPHA] } else { UNSEEN };
            self.face(scene, TriangleId::new(e), colour);
        }
    }

    /// Marks the shooting patch.
    pub fn shooter(&mut self, solved: &SolvedScene, patch: PatchId) {
        let (scene, mesh) = (&solved.baked.scene, &solved.mesh);
        let Some(patch) = mesh.patches.get(patch.index()) else { return };
        let members = mesh.members_of(patch).iter().map(|element| TriangleId::new(element.index()));
        let edges = borders(scene, members.clone(), |_| Some(0));
        self.lines.extend(edges.into_iter().flatten().map(|p| mark(p, SHOOTER_EDGE)));
        for element in members {
            self.face(scene, element, SHOOTER);
        }
    }

    /// Marks the locations of a piece of advice; points become small crosses.
    pub fn locations(&mut self, locations: &[Location]) {
        for &[a, b] in locations.iter().flat_map(|location| &location.lines) {
            if a == b {
                let arms = Vec3::AXES.map(|axis| POINT_SIZE * axis);
                self.lines.extend(arms.iter().flat_map(|&arm| [a - arm, a + arm]).map(|p| mark(p, LOCATION)));
            } else {
                self.lines.extend([a, b].map(|p| mark(p, LOCATION)));
            }
        }
    }

    /// Returns true if there are no marks.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.lines.is_empty() && self.triangles.is_empty()
    }

    fn face(&mut self, scene: &Scene, triangle: TriangleId, colour: [u8; 4]) {
        self.triangles.extend(scene.corners(triangle).map(|p| mark(p, colour)));
    }
}

fn mark(position: Vec3, colour: [u8; 4]) -> Mark {
    Mark { position, colour }
}

/// Returns each edge between two parts, and each edge of only one triangle, once. Corners with equal positions count as
/// one.
fn borders(
    scene: &Scene,
    triangles: impl Iterator<Item = TriangleId>,
    part_of: impl Fn(usize) -> Option<usize>,
) -> Vec<[Vec3; 2]> {
    let key = |p: Vec3| p.to_array().map(f32::to_bits);
    let mut parts: HashMap<_, (Option<usize>, u32, bool, [Vec3; 2])> = HashMap::new();
    for triangle in triangles.filter(|&t| !scene.sides.is_back(t)) {
        let corners = scene.corners(triangle);
        let part = part_of(triangle.index());
        for (a, b) in [(0, 1), (1, 2), (2, 0)].map(|(i, j)| (corners[i], corners[j])) {
            let edge = if key(a) <= key(b) { (key(a), key(b)) } else { (key(b), key(a)) };
            let found = parts.entry(edge).or_insert((part, 0, false, [a, b]));
            found.1 += 1;
            found.2 |= found.0 != part;
        }
    }
    let mut edges: Vec<_> = parts.into_iter().filter(|(_, (_, count, parts, _))| *count == 1 || *parts).collect();
    // The order of the map is random.
    edges.sort_by_key(|(edge, _)| *edge);
    edges.into_iter().map(|(_, (.., ends))| ends).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::builtin;

    #[test]
    fn each_edge_is_drawn_once_and_parts_only_at_their_border() {
        let scene = builtin::cornell();
        let all = || (0..scene.triangles.len()).map(TriangleId::new);
        let every = borders(&scene, all(), Some);
        let mut seen = std::collections::HashSet::new();
        let key = |p: Vec3| p.to_array().map(f32::to_bits);
        assert!(every.iter().all(|[a, b]| seen.insert((key(*a).min(key(*b)), key(*a).max(key(*b))))));
        let whole = borders(&scene, all(), |_| Some(0));
        assert!(whole.len() < every.len() && !whole.is_empty(), "{} of {}", whole.len(), every.len());
    }

    #[test]
    fn the_heat_map_tints_every_element() {
        let scene = builtin::cornell();
        let mut marks = Marks::default();
        marks.heat(&scene, &vec![0.5; scene.triangles.len()]);
        assert_eq!(marks.triangles.len(), 3 * scene.triangles.len());
        assert!(!marks.is_empty());
    }
}
