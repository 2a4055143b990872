//! Queries of rays on a scene: geometry by the tree, alpha by the materials.

use glam::{Vec3, Vec3A};

use super::wide::{Probe, WideTree};
use crate::base::ids::TriangleId;
use crate::scene::{AlphaMode, Scene, edge_cross};

/// Traces rays through one scene. The tree holds only the fronts of the scene, so that each surface is hit once.
pub struct Tracer<'a> {
    scene: &'a Scene,
    tree: WideTree,
    /// Leaves, in the order in which the tree numbers the triangles.
    leaves: Vec<Leaf>,
}

/// A triangle of the tree.
#[derive(Clone, Copy)]
struct Leaf {
    triangle: TriangleId,
    /// True if its material has no alpha, so that every ray that hits it ends.
    is_opaque: bool,
}

/// Transmittance below this counts as zero.
const DARK: f32 = 1e-3;

/// The nearest surface along a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, in multiples of the length of its direction vector.
    pub distance: f32,
    /// The triangle.
    pub triangle: TriangleId,
    /// Barycentric coordinates of the hit.
    pub barycentric: Vec3,
    /// True if the ray comes from the front.
    pub is_front: bool,
}

impl<'a> Tracer<'a> {
    /// Builds the tree.
    ///
    /// Cost: about a microsecond a triangle.
    #[must_use]
    pub fn new(scene: &'a Scene) -> Self {
        let leaves: Vec<Leaf> = scene
            .fronts()
            .map(|triangle| {
                let is_opaque = scene.material_of(triangle).alpha_mode == AlphaMode::Opaque;
                Leaf { triangle, is_opaque }
            })
            .collect();
        let corners: Vec<[Vec3A; 3]> =
            leaves.iter().map(|leaf| scene.corners(leaf.triangle).map(Vec3A::from)).collect();
        Self { scene, tree: WideTree::new(&corners), leaves }
    }

    /// The scene that is traced.
    #[must_use]
    pub fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// Returns the nearest surface along `direction` (any length) within `max_distance`. Rays pass through cut-outs,
    /// and through blended surfaces with less than half opacity.
    #[must_use]
    pub fn nearest(&self, origin: Vec3, direction: Vec3, max_distance: f32) -> Option<Hit> {
        self.nearest_solid(origin, direction, max_distance, |_| 0.5)
    }

    /// Returns the nearest surface like [`Tracer::nearest`], where `solid_from` gives for each triangle the smallest
    /// opacity that counts as solid, above 0. If this opacity is uniformly random in 0..1, the probability that a
    /// surface stops a ray equals its opacity.
    #[must_use]
    pub fn nearest_solid(
        &self,
        origin: Vec3,
        direction: Vec3,
        max_distance: f32,
        solid_from: impl Fn(TriangleId) -> f32,
    ) -> Option<Hit> {
        let mut found = None;
        self.tree.visit(&mut Probe::new(origin, direction, max_distance), |probe, quad| {
            let met = quad.meet(probe);
            for lane in lanes(met.lanes) {
                let leaf = &self.leaves[quad.triangles[lane] as usize];
                let (distance, u, v) = (met.distance[lane], met.u[lane], met.v[lane]);
                let is_nearer = distance < probe.reach;
                if is_nearer && (leaf.is_opaque || self.opacity_at(leaf, u, v) >= solid_from(leaf.triangle)) {
                    probe.reach = distance;
                    found = Some((leaf.triangle, u, v, distance));
                }
            }
            true
        });
        let (triangle, u, v, distance) = found?;
        let is_front = edge_cross(self.scene.corners(triangle)).dot(direction) < 0.0;
        Some(Hit { distance, triangle, barycentric: Vec3::new(1.0 - u - v, u, v), is_front })
    }

    /// Returns the share of light that passes along `direction` up to `max_distance`: the product of 1 - alpha over all
    /// surfaces on the way, 0 if one of them is opaque.
    #[must_use]
    pub fn transmittance(&self, origin: Vec3, direction: Vec3, max_distance: f32) -> f32 {
        let mut passing = 1.0;
        self.tree.visit(&mut Probe::new(origin, direction, max_distance), |probe, quad| {
            let met = quad.meet(probe);
            for lane in lanes(met.lanes) {
                let leaf = &self.leaves[quad.triangles[lane] as usize];
                passing *= if leaf.is_opaque { 0.0 } else { 1.0 - self.opacity_at(leaf, met.u[lane], met.v[lane]) };
            }
            passing >= DARK
        });
        if passing >= DARK { passing } else { 0.0 }
    }

    /// Returns the share of light that passes, per channel, like [`Tracer::transmittance`]. `pane` returns the share
    /// that passes through a triangle at a point with the given barycentric coordinates, or `None` if its alpha
    /// decides.
    #[must_use]
    pub fn coloured_transmittance(
        &self,
        origin: Vec3,
        direction: Vec3,
        max_distance: f32,
        pane: impl Fn(TriangleId, Vec3) -> Option<Vec3>,
    ) -> Vec3 {
        let mut passing = Vec3::ONE;
        self.tree.visit(&mut Probe::new(origin, direction, max_distance), |probe, quad| {
            let met = quad.meet(probe);
            for lane in lanes(met.lanes) {
                let leaf = &self.leaves[quad.triangles[lane] as usize];
                let (u, v) = (met.u[lane], met.v[lane]);
                passing *= match pane(leaf.triangle, Vec3::new(1.0 - u - v, u, v)) {
                    Some(share) => share,
                    None if leaf.is_opaque => Vec3::ZERO,
                    None => Vec3::splat(1.0 - self.opacity_at(leaf, u, v)),
                };
            }
            passing.max_element() >= DARK
        });
        if passing.max_element() >= DARK { passing } else { Vec3::ZERO }
    }

    fn opacity_at(&self, leaf: &Leaf, u: f32, v: f32) -> f32 {
        self.scene.surface_at(leaf.triangle, Vec3::new(1.0 - u - v, u, v)).opacity
    }
}

/// Returns the indices of the set bits.
fn lanes(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = bits.trailing_zeros() as usize;
        bits &= bits.wrapping_sub(1);
        (lane < 4).then_some(lane)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Material, SceneBuilder};
    use glam::Vec4;

    /// Unit squares facing +Z at the given heights.
    fn squares(heights: &[f32], alpha_mode: AlphaMode, alpha: f32) -> Scene {
        let material = Material { alpha_mode, base_colour: Vec4::new(1.0, 1.0, 1.0, alpha), ..Material::default() };
        let mut builder = SceneBuilder::default();
        let material = builder.material(material);
        for &z in heights {
            builder.quad([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vec3::new(x, y, z)), material);
        }
        builder.build()
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
    fn rays_along_an_axis_meet_flat_boxes_with_either_sign_of_zero() {
        let scene = squares(&[0.0], AlphaMode::Opaque, 1.0);
        let tracer = Tracer::new(&scene);
        for zeros in [[0.0, 0.0], [-0.0, 0.0], [0.0, -0.0], [-0.0, -0.0]] {
            let direction = Vec3::new(zeros[0], zeros[1], -1.0);
            assert!(tracer.nearest(Vec3::new(0.3, 0.4, 1e-3), direction, 2e-3).is_some(), "{direction}");
            assert_eq!(tracer.transmittance(Vec3::new(0.3, 0.4, 1e-3), direction, 2e-3), 0.0, "{direction}");
        }
    }

    #[test]
    fn two_half_transparent_squares_let_a_quarter_pass() {
        let scene = squares(&[0.0, 1.0], AlphaMode::Blend, 0.5);
        let passing = Tracer::new(&scene).transmittance(Vec3::new(0.3, 0.4, 5.0), Vec3::NEG_Z, 100.0);
        assert!((passing - 0.25).abs() < 1e-6, "{passing}");
    }

    #[test]
    fn cut_outs_let_all_light_pass() {
        let scene = squares(&[0.0], AlphaMode::Mask { cutoff: 0.5 }, 0.2);
        assert_eq!(Tracer::new(&scene).transmittance(Vec3::new(0.3, 0.4, 5.0), Vec3::NEG_Z, 100.0), 1.0);
    }
}
