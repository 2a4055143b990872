//! A bounding volume hierarchy over the scene's triangles.
//!
//! Source: Ylitie, Karras, Laine 2017 (the eight-wide tree, from the `obvhs` crate); Möller, Trumbore 1997 (triangles).

use glam::{Vec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::cwbvh::{CwBvh, builder::build_cwbvh_from_tris};
use obvhs::ray::{Ray, RayHit};
use obvhs::triangle::Triangle as BvhTriangle;

use crate::base::ids::TriangleId;
use crate::scene::{AlphaMode, Scene};

/// Answers ray queries on one scene. Backs of double-sided triangles that a bake wrote out are not in the tree.
pub struct Tracer<'a> {
    scene: &'a Scene,
    tree: CwBvh,
    /// In the order of the tree's leaves.
    leaves: Vec<Leaf>,
}

/// A triangle as the intersection test wants it.
#[derive(Clone, Copy)]
struct Leaf {
    corner: Vec3A,
    edge_1: Vec3A,
    edge_2: Vec3A,
    triangle: TriangleId,
    /// Every ray that meets it ends: no alpha to look up.
    is_opaque: bool,
}

/// What a ray meets first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Along the ray, in lengths of its direction vector.
    pub distance: f32,
    /// The triangle.
    pub triangle: TriangleId,
    /// Weights of the triangle's three corners at the hit.
    pub barycentric: Vec3,
    /// The ray comes from the front side.
    pub is_front: bool,
}

impl<'a> Tracer<'a> {
    /// Builds the tree.
    ///
    /// Cost: about a microsecond a triangle.
    #[must_use]
    pub fn new(scene: &'a Scene) -> Self {
        let ids: Vec<TriangleId> =
            (0..scene.triangles.len()).filter(|&t| !scene.triangles[t].is_back_side).map(TriangleId::new).collect();
        let corners = |id| scene.corners(id).map(Vec3A::from);
        let triangles: Vec<BvhTriangle> = ids
            .iter()
            .map(|&id| {
                let [v0, v1, v2] = corners(id);
                BvhTriangle { v0, v1, v2 }
            })
            .collect();
        let mut build_time = std::time::Duration::default();
        let tree = build_cwbvh_from_tris(&triangles, BvhBuildParams::medium_build(), &mut build_time);
        let leaves = tree
            .primitive_indices
            .iter()
            .map(|&at| {
                let triangle = ids[at as usize];
                let [v0, v1, v2] = corners(triangle);
                let is_opaque = scene.material_of(triangle).alpha_mode == AlphaMode::Opaque;
                Leaf { corner: v0, edge_1: v1 - v0, edge_2: v2 - v0, triangle, is_opaque }
            })
            .collect();
        Self { scene, tree, leaves }
    }

    /// The scene that is traced.
    #[must_use]
    pub fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// The nearest surface along `direction` (any length) closer than `max_distance`; cut-outs are passed through, and
    /// surfaces that blend count as solid from half opacity on.
    #[must_use]
    pub fn nearest(&self, origin: Vec3, direction: Vec3, max_distance: f32) -> Option<Hit> {
        self.nearest_solid(origin, direction, max_distance, |_| 0.5)
    }

    /// The nearest surface as [`Tracer::nearest`] finds it, where each triangle has its own smallest opacity, above 0,
    /// that counts as solid: drawn evenly from 0..1, it lets a surface pass the right share of all rays.
    #[must_use]
    pub fn nearest_solid(
        &self,
        origin: Vec3,
        direction: Vec3,
        max_distance: f32,
        solid_from: impl Fn(TriangleId) -> f32,
    ) -> Option<Hit> {
        let ray = ray(origin, direction, max_distance);
        let mut found = RayHit::none();
        self.tree.ray_traverse(ray, &mut found, |ray, at| {
            let leaf = &self.leaves[at];
            match leaf.intersect(ray) {
                Some((distance, u, v)) if self.opacity_at(leaf, u, v) >= solid_from(leaf.triangle) => distance,
                _ => f32::INFINITY,
            }
        });
        if found.t >= max_distance {
            return None;
        }
        let leaf = &self.leaves[found.primitive_id as usize];
        let (distance, u, v) = leaf.intersect(&ray)?;
        let normal = leaf.edge_1.cross(leaf.edge_2);
        Some(Hit {
            distance,
            triangle: leaf.triangle,
            barycentric: Vec3::new(1.0 - u - v, u, v),
            is_front: normal.dot(ray.direction) < 0.0,
        })
    }

    /// Share of light that passes along `direction` up to `max_distance`: 0 behind anything opaque, the product of
    /// 1 - alpha behind surfaces that blend.
    #[must_use]
    pub fn transmittance(&self, origin: Vec3, direction: Vec3, max_distance: f32) -> f32 {
        let ray = ray(origin, direction, max_distance);
        let mut passing = 1.0;
        let is_clear = self.tree.ray_traverse_miss(ray, |ray, at| match self.leaves[at].intersect(ray) {
            Some((distance, u, v)) => {
                passing *= 1.0 - self.opacity_at(&self.leaves[at], u, v);
                if passing < 1e-3 { distance } else { f32::INFINITY }
            }
            None => f32::INFINITY,
        });
        if is_clear { passing } else { 0.0 }
    }

    fn opacity_at(&self, leaf: &Leaf, u: f32, v: f32) -> f32 {
        if leaf.is_opaque {
            return 1.0;
        }
        self.scene.surface_at(leaf.triangle, Vec3::new(1.0 - u - v, u, v)).opacity
    }
}

/// The tree takes a component of -0 for positive in one place and for negative in another, and misses flat boxes; adding 0
/// makes it +0.
fn ray(origin: Vec3, direction: Vec3, max_distance: f32) -> Ray {
    Ray::new(origin.into(), (direction + Vec3::ZERO).into(), 0.0, max_distance)
}

impl Leaf {
    /// Distance along the ray and the barycentric weights of the second and third corner.
    fn intersect(&self, ray: &Ray) -> Option<(f32, f32, f32)> {
        let p = ray.direction.cross(self.edge_2);
        let determinant = self.edge_1.dot(p);
        if determinant == 0.0 {
            return None;
        }
        let inverse = 1.0 / determinant;
        let from_corner = ray.origin - self.corner;
        let u = from_corner.dot(p) * inverse;
        let q = from_corner.cross(self.edge_1);
        let v = ray.direction.dot(q) * inverse;
        let distance = self.edge_2.dot(q) * inverse;
        let is_inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        (is_inside && distance >= ray.tmin && distance < ray.tmax).then_some((distance, u, v))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::ids::{InstanceId, MaterialId};
    use crate::scene::{Instance, Material, Triangle, Vertex};
    use glam::{Vec2, Vec4};

    /// Unit squares facing +Z at the given heights.
    fn squares(heights: &[f32], alpha_mode: AlphaMode, alpha: f32) -> Scene {
        let mut scene = Scene::default();
        let material = Material { alpha_mode, base_colour: Vec4::new(1.0, 1.0, 1.0, alpha), ..Material::default() };
        scene.materials.push(material);
        for &z in heights {
            let first = scene.vertices.len() as u32;
            for (x, y) in [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)] {
                scene.vertices.push(Vertex {
                    position: Vec3::new(x, y, z),
                    normal: Vec3::Z,
                    uv: [Vec2::ZERO; 2],
                    colour: Vec4::ONE,
                });
            }
            for corners in [[0, 1, 2], [0, 2, 3]] {
                scene.triangles.push(Triangle {
                    vertices: corners.map(|c| first + c),
                    material: MaterialId(0),
                    instance: InstanceId(0),
                    is_back_side: false,
                });
            }
        }
        scene.instances.push(Instance { name: "squares".into(), triangles: 0..scene.triangles.len() });
        scene
    }

    #[test]
    fn the_nearest_of_several_squares_is_found_from_both_sides() {
        let scene = squares(&[0.0, 1.0, 2.0], AlphaMode::Opaque, 1.0);
        let tracer = Tracer::new(&scene);
        let from_above = tracer.nearest(Vec3::new(0.3, 0.4, 5.0), Vec3::NEG_Z, 100.0).expect("hit");
        assert!(from_above.is_front && (from_above.distance - 3.0).abs() < 1e-5);
        let from_below = tracer.nearest(Vec3::new(0.3, 0.4, -5.0), Vec3::Z, 100.0).expect("hit");
        assert!(!from_below.is_front && (from_below.distance - 5.0).abs() < 1e-5);
        assert!(tracer.nearest(Vec3::new(1.3, 0.4, 5.0), Vec3::NEG_Z, 100.0).is_none());
        assert!(tracer.nearest(Vec3::new(0.3, 0.4, 5.0), Vec3::NEG_Z, 2.9).is_none());
    }

    #[test]
    fn rays_along_an_axis_meet_flat_boxes_whatever_the_sign_of_zero() {
        let scene = squares(&[0.0], AlphaMode::Opaque, 1.0);
        let tracer = Tracer::new(&scene);
        for zeros in [[0.0, 0.0], [-0.0, 0.0], [0.0, -0.0], [-0.0, -0.0]] {
            let direction = Vec3::new(zeros[0], zeros[1], -1.0);
            assert!(tracer.nearest(Vec3::new(0.3, 0.4, 1e-3), direction, 2e-3).is_some(), "{direction}");
            assert_eq!(tracer.transmittance(Vec3::new(0.3, 0.4, 1e-3), direction, 2e-3), 0.0, "{direction}");
        }
    }

    #[test]
    fn two_half_transparent_squares_pass_a_quarter() {
        let scene = squares(&[0.0, 1.0], AlphaMode::Blend, 0.5);
        let passing = Tracer::new(&scene).transmittance(Vec3::new(0.3, 0.4, 5.0), Vec3::NEG_Z, 100.0);
        assert!((passing - 0.25).abs() < 1e-6, "{passing}");
    }

    #[test]
    fn cut_outs_pass_everything() {
        let scene = squares(&[0.0], AlphaMode::Mask { cutoff: 0.5 }, 0.2);
        assert_eq!(Tracer::new(&scene).transmittance(Vec3::new(0.3, 0.4, 5.0), Vec3::NEG_Z, 100.0), 1.0);
    }
}
