//! Collision and picking: the scene's triangles in a bounding volume hierarchy.
//!
//! Unlike the tracer of light ([`crate::trace`]), it supports box queries and owns its triangles, so it borrows no
//! scene. Alpha cut-outs and both sides of a face are solid.

use glam::{Vec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::{Bvh2, builder::build_bvh2};
use obvhs::ray::{Ray, RayHit};
use obvhs::triangle::Triangle;

use crate::base::bounds::Bounds;
use crate::base::ids::TriangleId;
use crate::base::triangle::closest_point;
use crate::scene::Scene;

/// The triangles of a scene as solids.
pub struct Collider {
    tree: Bvh2,
    /// Triangles in the order of the leaves of the tree.
    triangles: Vec<Triangle>,
    /// Index in the scene of each of `triangles`.
    numbers: Vec<TriangleId>,
    bounds: Bounds,
}

/// The visible surface in a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pick {
    /// Point of the surface, metres.
    pub point: Vec3,
    /// Unit normal of the visible side.
    pub normal: Vec3,
    /// The triangle in the scene.
    pub triangle: TriangleId,
}

/// The surface hit by a vertical ray.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// World height of the point, metres.
    pub height: f32,
    /// Unit normal that points up.
    pub normal: Vec3,
}

impl Collider {
    /// Builds the tree.
    ///
    /// Cost: about 1 us a triangle.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let fronts: Vec<TriangleId> = scene.fronts().collect();
        let solid: Vec<Triangle> = fronts
            .iter()
            .map(|&t| {
                let [v0, v1, v2] = scene.corners(t).map(Vec3A::from);
                Triangle { v0, v1, v2 }
            })
            .collect();
        let tree = build_bvh2(&solid, BvhBuildParams::medium_build(), &mut std::time::Duration::default());
        let triangles = tree.primitive_indices.iter().map(|&t| solid[t as usize]).collect();
        let numbers = tree.primitive_indices.iter().map(|&t| fronts[t as usize]).collect();
        Self { tree, triangles, numbers, bounds: scene.bounds() }
    }

    /// Returns the bounding box of the scene, metres.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Returns the highest surface below `from`, at most `depth` metres lower.
    #[must_use]
    pub fn below(&self, from: Vec3, depth: f32) -> Option<Surface> {
        self.vertical(from, Vec3A::NEG_Y, depth)
    }

    /// Returns the lowest surface above `from`, at most `height` metres higher.
    #[must_use]
    pub fn above(&self, from: Vec3, height: f32) -> Option<Surface> {
        self.vertical(from, Vec3A::Y, height)
    }

    /// Returns the first visible surface along the ray from `from` in `direction` (of any length). Backs of triangles
    /// for which `sees_back_of` is false are transparent.
    #[must_use]
    pub fn pick(&self, from: Vec3, direction: Vec3, sees_back_of: impl Fn(TriangleId) -> bool) -> Option<Pick> {
        let direction = direction.try_normalize()?;
        let hit = self.nearest(from, direction.into(), f32::MAX, |at| {
            let is_front = Vec3::from(self.triangles[at].compute_normal()).dot(direction) < 0.0;
            is_front || sees_back_of(self.numbers[at])
        })?;
        let at = hit.primitive_id as usize;
        let normal = Vec3::from(self.triangles[at].compute_normal()).normalize_or_zero();
        let seen = if normal.dot(direction) > 0.0 { -normal } else { normal };
        Some(Pick { point: from + direction * hit.t, normal: seen, triangle: self.numbers[at] })
    }

    fn vertical(&self, from: Vec3, direction: Vec3A, length: f32) -> Option<Surface> {
        let hit = self.nearest(from, direction, length, |_| true)?;
        let normal = Vec3::from(self.triangles[hit.primitive_id as usize].compute_normal());
        let up = if normal.y < 0.0 { -normal } else { normal };
        Some(Surface { height: from.y + direction.y * hit.t, normal: up })
    }

    fn nearest(&self, from: Vec3, direction: Vec3A, length: f32, stops: impl Fn(usize) -> bool) -> Option<RayHit> {
        if self.triangles.is_empty() {
            return None;
        }
        let mut hit = RayHit::none();
        let ray = Ray::new(from.into(), direction, 0.0, length);
        self.tree.ray_traverse(ray, &mut hit, |ray, at| {
            if stops(at) { self.triangles[at].intersect(ray) } else { f32::INFINITY }
        });
        (hit.t < length).then_some(hit)
    }

    /// Calls `touch` with the nearest point of each triangle within `radius` of `centre`.
    pub fn touches(&self, centre: Vec3, radius: f32, mut touch: impl FnMut(Vec3)) {
        let reach = Vec3A::splat(radius);
        let near = Aabb::new(Vec3A::from(centre) - reach, Vec3A::from(centre) + reach);
        self.tree.aabb_traverse(near, |tree, node| {
            let node = &tree.nodes[node as usize];
            let range = node.first_index as usize..(node.first_index + node.prim_count) as usize;
            for triangle in &self.triangles[range] {
                let point = closest_point([triangle.v0, triangle.v1, triangle.v2].map(Vec3::from), centre);
                if point.distance(centre) < radius {
                    touch(point);
                }
            }
            true
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn picking_passes_through_backs_unless_they_are_visible() {
        let scene = crate::scene::builtin::cornell();
        let collider = Collider::new(&scene);
        // The ray starts outside, behind the back wall, and points to the open front.
        let (from, direction) = (Vec3::new(2.7, 4.5, 12.0), Vec3::NEG_Z);
        let through = collider.pick(from, direction, |_| false);
        let stopped = collider.pick(from, direction, |_| true).expect("the wall");
        assert!(stopped.point.z > 5.0 && (stopped.normal - Vec3::Z).length() < 1e-5, "{stopped:?}");
        assert_ne!(through.map(|pick| pick.triangle), Some(stopped.triangle));
    }

    #[test]
    fn an_empty_scene_has_no_floor_and_no_walls() {
        let collider = Collider::new(&Scene::default());
        assert!(collider.below(Vec3::ZERO, 100.0).is_none());
        collider.touches(Vec3::ZERO, 1.0, |_| panic!("nothing is there"));
    }
}
