//! The binary tree that is collapsed into a wide one: built by two methods, of which the cheaper result is used.
//!
//! The surface area heuristic (SAH) estimates the cost of a tree. If a ray hits a box, the probability that it also
//! hits a box inside it is the ratio of their surface areas, so cost = sum over the nodes of area x cost of the node.
//! Clustering neighbours from below gives the lowest cost for most scenes. Exceptions are scenes with many equal
//! boxes, such as those of the elements of a bake: ties join them to long strips. Splitting from above, at the best of
//! some buckets along each axis, has no ties.
//!
//! Sources: Meister, Bittner 2018, "Parallel Locally-Ordered Clustering" (from below, by the `obvhs` crate); Wald 2007,
//! "On fast Construction of SAH-based Bounding Volume Hierarchies" (from above).

use std::time::Duration;

use glam::Vec3A;
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::triangle::Triangle;

/// Triangles that are tested at once.
const LEAF_SIZE: u32 = 4;

/// Cost of a node, and of a leaf with any number of triangles.
const NODE_COST: f32 = 4.0;

/// Buckets along each axis of a split.
const NUM_BUCKETS: usize = 32;

/// A binary tree over at least one triangle, with up to four in a leaf.
pub(super) fn binary_tree(triangles: &[[Vec3A; 3]]) -> Bvh2 {
    let [below, above] = [from_below(triangles), from_above(triangles)];
    if cost(&above) < cost(&below) { above } else { below }
}

/// Returns the expected number of nodes and leaves that a ray intersects, up to a factor (the surface area heuristic).
fn cost(tree: &Bvh2) -> f32 {
    tree.nodes.iter().map(|node| node.aabb().half_area()).sum()
}

fn from_below(triangles: &[[Vec3A; 3]]) -> Bvh2 {
    let boxed: Vec<Triangle> = triangles.iter().map(|&[v0, v1, v2]| Triangle { v0, v1, v2 }).collect();
    let settings = BvhBuildParams {
        max_prims_per_leaf: LEAF_SIZE,
        collapse_traversal_cost: NODE_COST,
        reinsertion_batch_ratio: 0.15,
        ..BvhBuildParams::medium_build()
    };
    build_bvh2_from_tris(&boxed, settings, &mut Duration::default())
}

fn from_above(triangles: &[[Vec3A; 3]]) -> Bvh2 {
    let boxes: Vec<Aabb> = triangles.iter().map(|corners| Aabb::from_points(corners)).collect();
    let mut numbers: Vec<u32> = (0..triangles.len() as u32).collect();
    let mut tree = Bvh2 { nodes: vec![Bvh2Node::default()], ..Bvh2::default() };
    grow(&mut tree, &boxes, &mut numbers, 0, 0);
    tree.primitive_indices = numbers;
    collapse(&mut tree, LEAF_SIZE, NODE_COST);
    tree
}

/// Makes node `at` the root over the boxes with the given numbers. `first` is the index of the first of these
/// numbers in the whole list.
fn grow(tree: &mut Bvh2, boxes: &[Aabb], numbers: &mut [u32], at: usize, first: usize) {
    let bounds = numbers.iter().fold(Aabb::empty(), |all, &n| all.union(&boxes[n as usize]));
    if numbers.len() == 1 {
        tree.nodes[at] = Bvh2Node::new(bounds, 1, first as u32);
        return;
    }
    let children = tree.nodes.len();
    tree.nodes[at] = Bvh2Node::new(bounds, 0, children as u32);
    tree.nodes.extend([Bvh2Node::default(); 2]);
    let num_left = split(boxes, numbers);
    let (left, right) = numbers.split_at_mut(num_left);
    grow(tree, boxes, left, children, first);
    grow(tree, boxes, right, children + 1, first + num_left);
}

/// Partitions the numbers at the split with the lowest cost, and returns the size of the first part.
fn split(boxes: &[Aabb], numbers: &mut [u32]) -> usize {
    let middle = |n: u32| boxes[n as usize].center();
    let middles = numbers.iter().fold(Aabb::empty(), |all, &n| all.union(&Aabb::from_point(middle(n))));
    let extent = middles.diagonal();
    let bucket = |n: u32, axis: usize| {
        let place = (middle(n) - middles.min)[axis] / extent[axis];
        ((place * NUM_BUCKETS as f32) as usize).min(NUM_BUCKETS - 1)
    };
    let mut best: Option<(f32, usize, usize)> = None;
    for axis in (0..3).filter(|&axis| extent[axis] > 0.0) {
        let mut buckets = [(Aabb::empty(), 0u32); NUM_BUCKETS];
        for &n in numbers.iter() {
            let (bounds, count) = &mut buckets[bucket(n, axis)];
            (*bounds, *count) = (bounds.union(&boxes[n as usize]), *count + 1);
        }
        // Running cost of the buckets, from either side.
        let add = |sum: &mut (Aabb, u32), (bounds, count): &(Aabb, u32)| {
            *sum = (sum.0.union(bounds), sum.1 + count);
            Some(if sum.1 > 0 { sum.0.half_area() * sum.1 as f32 } else { 0.0 })
        };
        let left: Vec<f32> = buckets.iter().scan((Aabb::empty(), 0), add).collect();
        let right: Vec<f32> = buckets.iter().rev().scan((Aabb::empty(), 0), add).collect();
        // The outermost buckets are never empty, so neither part is.
        for at in 1..NUM_BUCKETS {
            let cost = left[at - 1] + right[NUM_BUCKETS - 1 - at];
            if best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, axis, at));
            }
        }
    }
    let Some((_, axis, at)) = best else { return numbers.len() / 2 };
    numbers.sort_by_key(|&n| bucket(n, axis) >= at);
    numbers.partition_point(|&n| bucket(n, axis) < at)
}
