//! A four-wide bounding volume hierarchy (BVH): a tree of boxes, each with up to four children, over all triangles.
//!
//! A ray visits only the children whose boxes it hits, the nearest first, and skips boxes beyond the nearest hit. Four
//! boxes or four triangles are tested at once, one in each lane of a SIMD register. Every x86-64 and ARM64 processor
//! has four lanes, so no special build is needed. `binary` builds a binary tree, which is collapsed here into the wide
//! one; `lanes` holds the intersection tests, `stack` the nodes that a ray still has to visit.
//! Sources: Wald, Benthin, Boulos 2008, "Getting Rid of Packets" (wide trees for single rays); Möller, Trumbore 1997
//! (triangles).

mod binary;
mod lanes;
mod stack;

use glam::Vec3A;
use obvhs::bvh2::Bvh2;

use binary::binary_tree;
use lanes::Node;
pub(super) use lanes::{Leaf, Probe};
use stack::Stack;

/// Bit of a child that is a leaf; the other bits are its index.
const LEAF: u32 = 1 << 31;

/// The tree.
pub(super) struct WideTree {
    nodes: Vec<Node>,
    leaves: Vec<Leaf>,
}

impl WideTree {
    /// Builds the tree over triangles given by their corners.
    pub(super) fn new(triangles: &[[Vec3A; 3]]) -> Self {
        let mut tree = Self { nodes: Vec::new(), leaves: Vec::new() };
        if triangles.is_empty() {
            return tree;
        }
        tree.fold(&binary_tree(triangles), triangles, 0);
        tree
    }

    /// Adds the wide node of binary node `at` and returns its index. Its children are descendants of `at`: the largest
    /// is replaced by its two children until there are four.
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

    /// Visits the leaves whose boxes the ray hits within its reach, near ones first. The visitor may shorten the
    /// reach, and ends the walk by returning false.
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

#[cfg(test)]
mod tests {
    use glam::Vec3;

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

    /// Returns the nearest distance through the tree.
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
    fn the_tree_finds_the_nearest_of_all_triangles() {
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
    fn a_ray_meets_few_leaves_of_a_regular_grid() {
        // Elements of a wall, whose boxes are equal.
        const SIDE: u32 = 64;
        let corner = |x: u32, y: u32| Vec3A::new(x as f32, y as f32, 0.0);
        let halves = |i: u32| {
            let (x, y) = (i % SIDE, i / SIDE);
            let [a, b, c, d] = [corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)];
            [[a, b, c], [a, c, d]]
        };
        let tree = WideTree::new(&(0..SIDE * SIDE).flat_map(halves).collect::<Vec<_>>());
        let mut num_leaves = 0;
        for i in 0..100 {
            let at = SIDE as f32 * vector(3 * i);
            tree.visit(&mut Probe::new(at.with_z(1.0), Vec3::NEG_Z, 9.0), |_, _| {
                num_leaves += 1;
                true
            });
        }
        assert!(num_leaves < 200, "{num_leaves} leaves in 100 rays");
    }

    #[test]
    fn many_equal_triangles_are_all_visited() {
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
    fn an_empty_tree_is_never_hit() {
        assert_eq!(nearest(&WideTree::new(&[]), Vec3::ZERO, Vec3::X), f32::INFINITY);
    }
}
