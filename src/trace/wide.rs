//! A four-wide bounding volume hierarchy: four boxes, or four triangles, are met at once.
//!
//! Four lanes are what every x86-64 and ARM64 processor has, so that no other build is needed for fast rays.
//!
//! Sources: Wald, Benthin, Boulos 2008, "Getting Rid of Packets" (wide trees for single rays); Möller, Trumbore 1997
//! (triangles). The binary tree that is folded comes from the `obvhs` crate.

use glam::{Vec3, Vec3A, Vec4};
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::triangle::Triangle;

/// Marks a child that is a leaf; the other bits are its number.
const LEAF: u32 = 1 << 31;

/// Entries of the stack that need no memory from the heap.
const SHALLOW: usize = 48;

/// Every axis has a way through a box, however flat the ray.
const STEEPEST: f32 = 1e30;

/// Four children.
struct Node {
    /// Lower and upper bounds `[axis][bound]` of the four.
    bounds: [[Vec4; 2]; 3],
    children: [u32; 4],
}

/// Up to four triangles, lane by lane; lanes without one have edges of no length.
pub(super) struct Leaf {
    corner: [Vec4; 3],
    edge_1: [Vec4; 3],
    edge_2: [Vec4; 3],
    /// Numbers of the triangles in the list that the tree was built from.
    pub triangles: [u32; 4],
}

/// The tree.
pub(super) struct WideTree {
    nodes: Vec<Node>,
    leaves: Vec<Leaf>,
}

/// A ray that gets shorter while it is traced.
pub(super) struct Probe {
    origin: [Vec4; 3],
    direction: [Vec4; 3],
    inverse: [Vec4; 3],
    /// Which bound is met first, by axis.
    near: [usize; 3],
    /// Only what is nearer counts.
    pub reach: f32,
}

/// Where a ray meets the triangles of a leaf.
pub(super) struct Meeting {
    pub distance: [f32; 4],
    pub u: [f32; 4],
    pub v: [f32; 4],
    /// Lanes that are met within reach, lane 0 in the lowest bit.
    pub lanes: u32,
}

impl Probe {
    pub(super) fn new(origin: Vec3, direction: Vec3, reach: f32) -> Self {
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

impl WideTree {
    /// Builds the tree over triangles given by their corners.
    pub(super) fn new(triangles: &[[Vec3A; 3]]) -> Self {
        let boxed: Vec<Triangle> = triangles.iter().map(|&[v0, v1, v2]| Triangle { v0, v1, v2 }).collect();
        let mut tree = Self { nodes: Vec::new(), leaves: Vec::new() };
        if boxed.is_empty() {
            return tree;
        }
        // A leaf of four costs what a node costs.
        let settings = BvhBuildParams {
            max_prims_per_leaf: 4,
            collapse_traversal_cost: 4.0,
            reinsertion_batch_ratio: 0.15,
            ..BvhBuildParams::medium_build()
        };
        let binary = build_bvh2_from_tris(&boxed, settings, &mut std::time::Duration::default());
        tree.fold(&binary, triangles, 0);
        tree
    }

    /// Adds the node that stands for `at` and its nearest descendants, the largest opened first; hands back its number.
    fn fold(&mut self, binary: &Bvh2, triangles: &[[Vec3A; 3]], at: u32) -> u32 {
        let node_of = |at: u32| &binary.nodes[at as usize];
        let mut members = vec![at];
        while members.len() < 4 {
            let area = |&m: &u32| node_of(m).aabb.half_area();
            let inner = members.iter().enumerate().filter(|(_, m)| node_of(**m).prim_count == 0);
            let Some((place, _)) = inner.max_by(|a, b| area(a.1).total_cmp(&area(b.1))) else { break };
            let first = node_of(members[place]).first_index;
            members[place] = first;
            members.push(first + 1);
        }
        let number = self.nodes.len();
        self.nodes.push(Node::around(
            members.iter().map(|&m| node_of(m).aabb.min),
            members.iter().map(|&m| node_of(m).aabb.max),
        ));
        for (lane, &member) in members.iter().enumerate() {
            let node = node_of(member);
            self.nodes[number].children[lane] = if node.prim_count == 0 {
                self.fold(binary, triangles, member)
            } else {
                let range = node.first_index as usize..(node.first_index + node.prim_count) as usize;
                self.leaves.push(Leaf::new(&binary.primitive_indices[range], triangles));
                LEAF | (self.leaves.len() - 1) as u32
            };
        }
        number as u32
    }

    /// Visits the leaves whose boxes the ray meets, the nearer ones first, as far as its reach, which the visitor may
    /// shorten; ends when the visitor says false.
    #[inline]
    pub(super) fn visit(&self, probe: &mut Probe, mut visitor: impl FnMut(&mut Probe, &Leaf) -> bool) {
        let mut stack = Stack::new();
        let mut next = if self.nodes.is_empty() { None } else { Some(0) };
        while let Some(at) = next {
            if at & LEAF != 0 {
                if !visitor(probe, &self.leaves[(at & !LEAF) as usize]) {
                    return;
                }
                next = stack.pop(probe.reach);
                continue;
            }
            let node = &self.nodes[at as usize];
            let (distances, mut lanes) = node.meet(probe);
            let mut nearest: Option<(f32, u32)> = None;
            while lanes != 0 {
                let lane = lanes.trailing_zeros() as usize;
                lanes &= lanes - 1;
                let found = (distances[lane], node.children[lane]);
                match nearest {
                    Some(kept) if kept.0 <= found.0 => stack.push(found),
                    Some(kept) => {
                        stack.push(kept);
                        nearest = Some(found);
                    }
                    None => nearest = Some(found),
                }
            }
            next = match nearest {
                Some((_, child)) => Some(child),
                None => stack.pop(probe.reach),
            };
        }
    }
}

impl Node {
    /// A node round up to four boxes; the rest is never met.
    fn around(lows: impl Iterator<Item = Vec3A>, highs: impl Iterator<Item = Vec3A>) -> Self {
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

    /// Distances to the four boxes and which of them are met.
    #[inline]
    fn meet(&self, probe: &Probe) -> ([f32; 4], u32) {
        let along = |axis: usize, bound: usize| (self.bounds[axis][bound] - probe.origin[axis]) * probe.inverse[axis];
        let [x, y, z] = probe.near;
        let enter = along(0, x).max(along(1, y)).max(along(2, z).max(Vec4::ZERO));
        let leave = along(0, 1 - x).min(along(1, 1 - y)).min(along(2, 1 - z).min(Vec4::splat(probe.reach)));
        // A hair of slack for rounding (Ize 2013, "Robust BVH Ray Traversal").
        (enter.to_array(), enter.cmple(leave * (1.0 + 4.0 * f32::EPSILON)).bitmask())
    }
}

impl Leaf {
    fn new(numbers: &[u32], triangles: &[[Vec3A; 3]]) -> Self {
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

    /// Distances along the ray, weights of the second and third corner, and which triangles are met.
    #[inline]
    pub(super) fn meet(&self, probe: &Probe) -> Meeting {
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

/// What is still to be visited, with the distance to its box.
struct Stack {
    shallow: [(f32, u32); SHALLOW],
    length: usize,
    deep: Vec<(f32, u32)>,
}

impl Stack {
    #[inline]
    fn new() -> Self {
        Self { shallow: [(0.0, 0); SHALLOW], length: 0, deep: Vec::new() }
    }

    #[inline]
    fn push(&mut self, entry: (f32, u32)) {
        match self.shallow.get_mut(self.length) {
            Some(place) => {
                *place = entry;
                self.length += 1;
            }
            None => self.deep.push(entry),
        }
    }

    /// The last entry whose box is within reach.
    #[inline]
    fn pop(&mut self, reach: f32) -> Option<u32> {
        while let Some((distance, child)) = self.deep.pop() {
            if distance <= reach {
                return Some(child);
            }
        }
        while self.length > 0 {
            self.length -= 1;
            let (distance, child) = self.shallow[self.length];
            if distance <= reach {
                return Some(child);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::sampling::{hash, unit_float};

    fn vector(seed: u32) -> Vec3 {
        Vec3::new(unit_float(hash(seed)), unit_float(hash(seed + 1)), unit_float(hash(seed + 2)))
    }

    fn random_triangles(count: u32) -> Vec<[Vec3A; 3]> {
        let triangle = |i: u32| {
            let at = vector(100 * i);
            [at, at + 0.1 * vector(100 * i + 10), at + 0.1 * vector(100 * i + 20)].map(Vec3A::from)
        };
        (0..count).map(triangle).collect()
    }

    /// Nearest distance through the tree.
    fn nearest(tree: &WideTree, origin: Vec3, direction: Vec3) -> f32 {
        let mut probe = Probe::new(origin, direction, f32::INFINITY);
        tree.visit(&mut probe, |probe, leaf| {
            let met = leaf.meet(probe);
            let lanes = (0..4).filter(|lane| met.lanes >> lane & 1 == 1);
            probe.reach = lanes.map(|lane| met.distance[lane]).fold(probe.reach, f32::min);
            true
        });
        probe.reach
    }

    #[test]
    fn the_tree_finds_what_a_look_at_every_triangle_finds() {
        let triangles = random_triangles(700);
        let tree = WideTree::new(&triangles);
        let single: Vec<WideTree> = triangles.iter().map(|triangle| WideTree::new(&[*triangle])).collect();
        let mut num_hits = 0;
        for i in 0..500 {
            let (origin, mut direction) = (vector(9 * i + 70_000), vector(9 * i + 80_000) - 0.5);
            if i % 5 == 0 {
                direction[i as usize % 3] = 0.0;
            }
            let expected = single.iter().map(|one| nearest(one, origin, direction)).fold(f32::INFINITY, f32::min);
            assert_eq!(nearest(&tree, origin, direction), expected, "ray {i}");
            num_hits += u32::from(expected.is_finite());
        }
        assert!(num_hits > 100 && num_hits < 500, "{num_hits}");
    }

    #[test]
    fn many_triangles_in_one_place_are_all_visited() {
        let triangles = vec![[Vec3A::ZERO, Vec3A::X, Vec3A::Y]; 3000];
        let tree = WideTree::new(&triangles);
        let mut num_met = 0;
        tree.visit(&mut Probe::new(Vec3::new(0.2, 0.2, 1.0), Vec3::NEG_Z, 9.0), |probe, leaf| {
            num_met += leaf.meet(probe).lanes.count_ones();
            true
        });
        assert_eq!(num_met, 3000);
    }

    #[test]
    fn an_empty_tree_is_met_by_nothing() {
        assert_eq!(nearest(&WideTree::new(&[]), Vec3::ZERO, Vec3::X), f32::INFINITY);
    }
}
