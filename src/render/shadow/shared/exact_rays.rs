//! Lines of sight in double precision, watertight at the edges of triangles.
//!
//! The side on which a line passes an edge is computed in the same order of operations for both triangles at the edge.
//! So a line along the edge hits at least one of them (Woop, Benthin and Wald 2013, "Watertight Ray/Triangle
//! Intersection", there in single precision). These rays are the reference for all techniques: they are slower than
//! `trace::Tracer` and share no code with it.

use std::sync::Arc;

use glam::{DVec3, DVec4, Vec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;

use crate::base::ids::TriangleId;
use crate::scene::{AlphaMode, Scene};

/// Margin of a box round its triangles, as a share of the scene's extent.
const SLACK: f32 = 1e-6;
/// Smallest opacity of a surface that blocks light.
const HALF_OPAQUE: f32 = 0.5;

/// The triangles of a scene in a tree of boxes.
pub struct ExactRays {
    scene: Arc<Scene>,
    triangles: Vec<Triangle>,
    tree: Bvh2,
}

struct Triangle {
    id: TriangleId,
    corners: [DVec3; 3],
    is_opaque: bool,
}

/// Intersection of a line with a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The triangle.
    pub triangle: TriangleId,
    /// Distance along the line, in lengths of its direction.
    pub distance: f64,
}

/// A line from `origin` along `direction`, up to `reach` lengths of it.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// Start of the line, metres.
    pub origin: DVec3,
    /// Direction, of any length.
    pub direction: DVec3,
    /// End of the line, in lengths of `direction`; may be infinite.
    pub reach: f64,
}

impl Line {
    /// Returns the line from a point to a homogeneous position: w = 1 for a point, w = 0 for a direction.
    #[must_use]
    pub fn between(origin: DVec3, position: DVec4) -> Self {
        let direction = position.truncate() - position.w * origin;
        Self { origin, direction, reach: if position.w == 0.0 { f64::INFINITY } else { 1.0 } }
    }
}

impl ExactRays {
    /// Builds a tree over all triangles, without the back faces that a bake has added.
    #[must_use]
    pub fn new(scene: Arc<Scene>) -> Self {
        let triangles: Vec<Triangle> = scene
            .fronts()
            .map(|id| Triangle {
                id,
                corners: scene.corners(id).map(Vec3::as_dvec3),
                is_opaque: scene.material_of(id).alpha_mode == AlphaMode::Opaque,
            })
            .collect();
        let slack = Vec3A::splat(SLACK * scene.bounds().extent());
        let boxes: Vec<Aabb> = triangles
            .iter()
            .map(|triangle| {
                let [a, b, c] = scene.corners(triangle.id).map(Vec3A::from);
                Aabb::new(a.min(b).min(c) - slack, a.max(b).max(c) + slack)
            })
            .collect();
        let tree = if boxes.is_empty() {
            Bvh2::default()
        } else {
            build_bvh2(&boxes, BvhBuildParams::fast_build(), &mut std::time::Duration::default())
        };
        Self { scene, triangles, tree }
    }

    /// Returns true if a solid surface lies on the line, its ends excluded.
    #[must_use]
    pub fn is_blocked(&self, line: Line) -> bool {
        let mut is_blocked = false;
        self.visit(line, |_| {
            is_blocked = true;
            false
        });
        is_blocked
    }

    /// Returns the hit whose distance along the line is closest to `distance`.
    #[must_use]
    pub fn nearest_to(&self, line: Line, distance: f64) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        self.visit(line, |hit| {
            if best.is_none_or(|best| (hit.distance - distance).abs() < (best.distance - distance).abs()) {
                best = Some(hit);
            }
            true
        });
        best
    }

    /// Returns the corners of a triangle, metres.
    #[must_use]
    pub fn corners(&self, id: TriangleId) -> [DVec3; 3] {
        self.scene.corners(id).map(Vec3::as_dvec3)
    }

    /// Calls `visitor` for each hit on the line, in any order, until it returns false.
    fn visit(&self, line: Line, mut visitor: impl FnMut(Hit) -> bool) {
        let inverse = line.direction.recip();
        let mut stack = vec![0];
        while let Some(at) = stack.pop() {
            let Some(node) = self.tree.nodes.get(at as usize) else { continue };
            if !meets_box(node.aabb(), line, inverse) {
                continue;
            }
            if !node.is_leaf() {
                stack.extend([node.first_index, node.first_index + 1]);
                continue;
            }
            for index in node.first_index..node.first_index + node.prim_count {
                let triangle = &self.triangles[self.tree.primitive_indices[index as usize] as usize];
                if self.meet(triangle, line).is_some_and(|hit| !visitor(hit)) {
                    return;
                }
            }
        }
    }

    fn meet(&self, triangle: &Triangle, line: Line) -> Option<Hit> {
        let [a, b, c] = triangle.corners;
        let passes = [[b, c], [c, a], [a, b]].map(|[from, to]| side_of_edge(line, from, to));
        let is_inside = passes.iter().all(|&side| side >= 0.0) || passes.iter().all(|&side| side <= 0.0);
        let total: f64 = passes.iter().sum();
        // If the sum is 0, the line lies in the plane of the triangle, which then does not block it.
        if !is_inside || total == 0.0 {
            return None;
        }
        let normal = (b - a).cross(c - a);
        let distance = normal.dot(a - line.origin) / normal.dot(line.direction);
        if !(distance > 0.0 && distance < line.reach) {
            return None;
        }
        let weights = DVec3::from_array(passes) / total;
        let is_solid =
            triangle.is_opaque || self.scene.surface_at(triangle.id, weights.as_vec3()).opacity >= HALF_OPAQUE;
        is_solid.then_some(Hit { triangle: triangle.id, distance })
    }
}

/// Returns on which side of an edge the line passes, by sign: the scalar triple product d . ((a - o) x (b - o)).
///
/// The ends are ordered by position first, so swapping `from` and `to` yields exactly the negated value.
fn side_of_edge(line: Line, from: DVec3, to: DVec3) -> f64 {
    let is_in_order = from.to_array() < to.to_array();
    let [low, high] = if is_in_order { [from, to] } else { [to, from] };
    let side = line.direction.dot((low - line.origin).cross(high - line.origin));
    if is_in_order { side } else { -side }
}

fn meets_box(aabb: &Aabb, line: Line, inverse: DVec3) -> bool {
    let (low, high) = (aabb.min.as_dvec3(), aabb.max.as_dvec3());
    let (mut enter, mut leave) = (0.0_f64, line.reach);
    for axis in 0..3 {
        if line.direction[axis] == 0.0 {
            if line.origin[axis] < low[axis] || line.origin[axis] > high[axis] {
                return false;
            }
            continue;
        }
        let at = |bound: f64| (bound - line.origin[axis]) * inverse[axis];
        let (near, far) = if inverse[axis] > 0.0 { (low, high) } else { (high, low) };
        enter = enter.max(at(near[axis]));
        leave = leave.min(at(far[axis]));
    }
    enter <= leave
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::ids::{InstanceId, MaterialId};
    use crate::base::sampling::{hash, unit_float};
    use crate::scene::{Material, Triangle as SceneTriangle, Vertex};

    /// Returns a fan of triangles round a point, with coordinates that are not round numbers.
    fn fan(num_blades: u32) -> Scene {
        let mut scene = Scene { materials: vec![Material::default()], ..Scene::default() };
        let mut corner = |position| {
            scene.vertices.push(Vertex::new(position, Vec3::Y));
            scene.vertices.len() as u32 - 1
        };
        let middle = corner(Vec3::new(0.123, 0.456, -0.789));
        let rim = |i: u32| {
            let angle = (i % num_blades) as f32 / num_blades as f32 * std::f32::consts::TAU;
            Vec3::new(7.1 * angle.cos(), 0.3 * unit_float(hash(i % num_blades)), 7.1 * angle.sin())
        };
        let blades: Vec<[u32; 3]> = (0..num_blades).map(|i| [middle, corner(rim(i + 1)), corner(rim(i))]).collect();
        let triangle = |vertices| SceneTriangle { vertices, material: MaterialId(0), instance: InstanceId(0) };
        scene.triangles = blades.into_iter().map(triangle).collect();
        scene
    }

    #[test]
    fn no_line_slips_through_an_edge_or_a_corner() {
        let scene = fan(23);
        let rays = ExactRays::new(Arc::new(scene.clone()));
        for i in 0..2000 {
            let weight = unit_float(hash(i));
            let [a, b, _] = scene.corners(TriangleId::new(i as usize % 23));
            // A point on an edge, in single precision; every tenth is the corner that all triangles share.
            let target = if i % 10 == 0 { a } else { a.lerp(b, 0.9 * weight) };
            let origin = DVec3::new(f64::from(weight) * 3.0 - 1.0, 5.0, f64::from(unit_float(hash(i + 9))) * 2.0);
            let line = Line { origin, direction: target.as_dvec3() - origin, reach: f64::INFINITY };
            assert!(rays.is_blocked(line), "line {i}");
        }
    }

    #[test]
    fn the_ends_of_a_line_do_not_block_it() {
        let rays = ExactRays::new(Arc::new(fan(5)));
        let above = Line { origin: DVec3::new(1.0, 5.0, 0.5), direction: DVec3::NEG_Y, reach: f64::INFINITY };
        let hit = rays.nearest_to(above, 0.0).expect("the fan is below");
        assert!(rays.is_blocked(Line { reach: hit.distance * 1.0001, ..above }));
        assert!(!rays.is_blocked(Line { reach: hit.distance * 0.9999, ..above }));
        assert!(!rays.is_blocked(Line { direction: DVec3::Y, ..above }));
    }
}
