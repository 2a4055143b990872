//! Intersection of a ray with four boxes or four triangles at once, one in each lane.
//!
//! Boxes are tested by the slab test: the ray is within the box between the largest of the three entries and the
//! smallest of the three exits, t = (bound - origin) / direction along each axis.
//!
//! Triangles are tested as in Möller, Trumbore 1997: `o + t d = a + u e1 + v e2` is solved for t, u and v by Cramer's
//! rule.

use glam::{Vec3, Vec3A, Vec4};

/// Largest inverse of a direction, so that rays parallel to an axis have no infinities.
const STEEPEST: f32 = 1e30;

/// Four children.
pub(super) struct Node {
    /// Lower and upper bounds `[axis][bound]` of the four.
    bounds: [[Vec4; 2]; 3],
    pub children: [u32; 4],
}

/// Up to four triangles, lane by lane. Lanes without a triangle have edges of length 0.
pub(in crate::trace) struct Leaf {
    corner: [Vec4; 3],
    edge_1: [Vec4; 3],
    edge_2: [Vec4; 3],
    /// Numbers of the triangles in the list that the tree is built from.
    pub triangles: [u32; 4],
}

/// A ray whose reach shrinks while it is traced.
pub(in crate::trace) struct Probe {
    origin: [Vec4; 3],
    direction: [Vec4; 3],
    inverse: [Vec4; 3],
    /// Index of the bound that the ray reaches first, by axis.
    near: [usize; 3],
    /// Surfaces beyond this distance are ignored.
    pub reach: f32,
}

/// Intersections of a ray with the triangles of a leaf.
pub(in crate::trace) struct Meeting {
    pub distance: [f32; 4],
    pub u: [f32; 4],
    pub v: [f32; 4],
    /// Lanes whose triangles are hit within reach, lane 0 in the lowest bit.
    pub lanes: u32,
}

impl Probe {
    pub(in crate::trace) fn new(origin: Vec3, direction: Vec3, reach: f32) -> Self {
        let splat = |v: Vec3| v.to_array().map(Vec4::splat);
        let inverse = direction.map(|d| if d.abs() < 1.0 / STEEPEST { STEEPEST.copysign(d) } else { 1.0 / d });
        Self {
            origin: splat(origin),
            direction: splat(direction),
            inverse: splat(inverse),
            near: direction.to_array().map(|d| usize::from(d.is_sign_negative())),
            reach,
        }
    }
}

impl Node {
    /// Returns a node of up to four boxes. Unused lanes are never hit.
    pub(super) fn around(lows: impl Iterator<Item = Vec3A>, highs: impl Iterator<Item = Vec3A>) -> Self {
        let lanes = |corners: &mut dyn Iterator<Item = Vec3A>, nowhere: f32| {
            let mut axes = [Vec4::splat(nowhere); 3];
            for (lane, corner) in corners.enumerate() {
                for axis in 0..3 {
                    axes[axis][lane] = corner[axis];
                }
            }
            axes
        };
        let (low, high) = (lanes(&mut { lows }, f32::INFINITY), lanes(&mut { highs }, f32::NEG_INFINITY));
        Self { bounds: std::array::from_fn(|axis| [low[axis], high[axis]]), children: [0; 4] }
    }

    /// Returns the distances to the four boxes and the lanes of the boxes that are hit.
    #[inline]
    pub(super) fn meet(&self, probe: &Probe) -> ([f32; 4], u32) {
        let along = |axis: usize, bound: usize| (self.bounds[axis][bound] - probe.origin[axis]) * probe.inverse[axis];
        let [x, y, z] = probe.near;
        let enter = along(0, x).max(along(1, y)).max(along(2, z).max(Vec4::ZERO));
        let leave = along(0, 1 - x).min(along(1, 1 - y)).min(along(2, 1 - z).min(Vec4::splat(probe.reach)));
        // Slack for rounding (Ize 2013, "Robust BVH Ray Traversal").
        (enter.to_array(), enter.cmple(leave * (1.0 + 4.0 * f32::EPSILON)).bitmask())
    }
}

impl Leaf {
    pub(super) fn new(numbers: &[u32], triangles: &[[Vec3A; 3]]) -> Self {
        let mut leaf = Self {
            corner: [Vec4::ZERO; 3],
            edge_1: [Vec4::ZERO; 3],
            edge_2: [Vec4::ZERO; 3],
            triangles: [u32::MAX; 4],
        };
        for (lane, &number) in numbers.iter().enumerate() {
            let [a, b, c] = triangles[number as usize];
            for axis in 0..3 {
                leaf.corner[axis][lane] = a[axis];
                leaf.edge_1[axis][lane] = (b - a)[axis];
                leaf.edge_2[axis][lane] = (c - a)[axis];
            }
            leaf.triangles[lane] = number;
        }
        leaf
    }

    /// Returns distances along the ray, barycentric coordinates of the second and third corner, and the lanes of the
    /// triangles that are hit.
    #[inline]
    pub(in crate::trace) fn meet(&self, probe: &Probe) -> Meeting {
        let p = cross(probe.direction, self.edge_2);
        let inverse = Vec4::ONE / dot(self.edge_1, p);
        let from_corner = std::array::from_fn(|axis| probe.origin[axis] - self.corner[axis]);
        let u = dot(from_corner, p) * inverse;
        let q = cross(from_corner, self.edge_1);
        let v = dot(probe.direction, q) * inverse;
        let distance = dot(self.edge_2, q) * inverse;
        let is_inside = u.cmpge(Vec4::ZERO) & v.cmpge(Vec4::ZERO) & (u + v).cmple(Vec4::ONE);
        let is_near = distance.cmpge(Vec4::ZERO) & distance.cmplt(Vec4::splat(probe.reach));
        Meeting {
            distance: distance.to_array(),
            u: u.to_array(),
            v: v.to_array(),
            lanes: (is_inside & is_near).bitmask(),
        }
    }
}

#[inline]
fn cross(a: [Vec4; 3], b: [Vec4; 3]) -> [Vec4; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline]
fn dot(a: [Vec4; 3], b: [Vec4; 3]) -> Vec4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
