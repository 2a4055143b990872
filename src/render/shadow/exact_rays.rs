//! Lines of sight in double precision: nothing slips through where triangles meet.
//!
//! On which side of an edge a line passes is computed once an edge, the same for both of its triangles, so a line that
//! passes along the edge meets at least one of them (Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection",
//! there in single precision). Slower than `trace::Tracer`, and independent of it: these are the rays of the truth.

use std::sync::Arc;

use glam::{DVec3, DVec4, Vec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;

use crate::base::ids::TriangleId;
use crate::scene::{AlphaMode, Scene};

/// Boxes are this much wider than what they hold, as a share of the scene's extent.
const SLACK: f32 = 1e-6;
/// Opacity from which on a surface counts as solid.
const HALF_OPAQUE: f32 = 0.5;

/// A scene whose lines of sight can be asked for.
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

/// Where a line meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// Which.
    pub triangle: TriangleId,
    /// Along the line, in lengths of its direction.
    pub distance: f64,
}

/// A line from `origin` along `direction`, up to `reach` lengths of it.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// Metres.
    pub origin: DVec3,
    /// Of any length.
    pub direction: DVec3,
    /// In lengths of `direction`, may be infinite.
    pub reach: f64,
}

impl Line {
    /// From a point to a homogeneous place.
    #[must_use]
    pub fn between(origin: DVec3, place: DVec4) -> Self {
        let direction = place.truncate() - place.w * origin;
        Self { origin, direction, reach: if place.w == 0.0 { f64::INFINITY } else { 1.0 } }
    }
}

impl ExactRays {
    /// Builds a tree over all triangles but the backs that a bake has written out.
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

    /// Something solid lies on the line, its ends left out.
    #[must_use]
    pub fn is_blocked(&self, line: Line) -> bool {
        let mut is_blocked = false;
        self.visit(line, |_| {
            is_blocked = true;
            false
        });
        is_blocked
    }

    /// The solid place on the line nearest to `distance`.
    #[must_use]
    pub fn nearest_to(&self, line: Line, distance: f64) -> Option<Meeting> {
        let mut best: Option<Meeting> = None;
        self.visit(line, |met| {
            if best.is_none_or(|best| (met.distance - distance).abs() < (best.distance - distance).abs()) {
                best = Some(met);
            }
            true
        });
        best
    }

    /// Corners of a triangle.
    #[must_use]
    pub fn corners(&self, id: TriangleId) -> [DVec3; 3] {
        self.scene.corners(id).map(Vec3::as_dvec3)
    }

    /// Visits all solid places on the line until the visitor says false.
    fn visit(&self, line: Line, mut visitor: impl FnMut(Meeting) -> bool) {
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
            for place in node.first_index..node.first_index + node.prim_count {
                let triangle = &self.triangles[self.tree.primitive_indices[place as usize] as usize];
                if self.meet(triangle, line).is_some_and(|met| !visitor(met)) {
                    return;
                }
            }
        }
    }

    fn meet(&self, triangle: &Triangle, line: Line) -> Option<Meeting> {
        let [a, b, c] = triangle.corners;
        let passes = [[b, c], [c, a], [a, b]].map(|[from, to]| side_of_edge(line, from, to));
        let is_inside = passes.iter().all(|&side| side >= 0.0) || passes.iter().all(|&side| side <= 0.0);
        let total: f64 = passes.iter().sum();
        // Within the plane of a triangle nothing is behind it.
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
        is_solid.then_some(Meeting { triangle: triangle.id, distance })
    }
}

/// Positive where the line passes an edge on its one side, negative on the other; from `to` to `from` it is exactly the
/// negative.
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

    /// A fan of triangles round a point, whose corners have no round numbers.
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
            // A point of an edge as well as single precision can tell it; every tenth is the corner that all share.
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
        let met = rays.nearest_to(above, 0.0).expect("the fan is below");
        assert!(rays.is_blocked(Line { reach: met.distance * 1.0001, ..above }));
        assert!(!rays.is_blocked(Line { reach: met.distance * 0.9999, ..above }));
        assert!(!rays.is_blocked(Line { direction: DVec3::Y, ..above }));
    }
}
