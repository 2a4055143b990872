//! Chooses which nodes of the bisection trees are drawn as one triangle each, so that there are few triangles and the
//! mesh has no gaps.
//!
//! A vertex in the middle of an edge can be removed if all triangles that touch it are halves created by it. Then all
//! pairs of halves, on both sides of the edge, are joined at once, and the mesh stays conforming. Vertices of the
//! shortest edges are removed first.
//!
//! Source: Chen, Zhang 2010, "A coarsening algorithm on adaptive grids by newest vertex bisection and its
//! applications".

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::Range;

use glam::{IVec2, Vec3};
use rustc_hash::FxHashMap;

use super::bisection::{Forest, Halves};
use crate::scene::Scene;

/// Largest level of a tile, whose sides are cut into `2^level` parts.
pub(super) const MAX_LEVEL: u32 = 7;
/// Level of the grid on which the level of a node is determined. Finer elements would need too large a tile.
const FINEST: u32 = 20;

/// A node that is drawn as one triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Whole {
    pub node: u32,
    /// Corners of its elements lie on a grid that cuts its sides into `2^level` parts.
    pub level: u32,
}

/// Returns the number of texels of a tile: its grid and a margin of one texel.
pub(super) const fn num_texels(level: u32) -> u64 {
    ((1 << level) + 3) * ((1 << level) + 3)
}

/// Joins triangles as long as their tiles have at most this many texels per element.
pub(super) fn coarsen(scene: &Scene, forest: &Forest, texels_per_element: u64) -> Vec<Whole> {
    let mut coarsening = Coarsening::new(scene, forest);
    let mut queue: BinaryHeap<_> = (0..coarsening.halved_at.len() as u32)
        .filter(|&place| !coarsening.halved_at[place as usize].is_empty())
        .map(|place| (Reverse(coarsening.length_at(place)), place))
        .collect();
    while let Some((_, place)) = queue.pop() {
        for parent in coarsening.remove(place, texels_per_element) {
            let above = coarsening.middle_of(parent);
            queue.push((Reverse(coarsening.length_at(above)), above));
        }
    }
    let is_whole = |&node: &u32| coarsening.levels[node as usize].is_some();
    let nodes = (0..forest.nodes.len() as u32).filter(is_whole);
    nodes.map(|node| Whole { node, level: coarsening.levels[node as usize].unwrap_or(0) }).collect()
}

struct Coarsening<'a> {
    scene: &'a Scene,
    forest: &'a Forest,
    /// Place of each vertex `[v]`: vertices at the same position share a place.
    place_of: Vec<u32>,
    /// Number of whole triangles that touch each place.
    touching: Vec<u32>,
    /// Nodes that are halved at each place, a range of `halved`.
    halved_at: Vec<Range<u32>>,
    halved: Vec<u32>,
    /// Levels of the nodes that are triangles of the current mesh; `None` for the others.
    levels: Vec<Option<u32>>,
}

impl<'a> Coarsening<'a> {
    fn new(scene: &'a Scene, forest: &'a Forest) -> Self {
        let mut places: FxHashMap<[u32; 3], u32> = FxHashMap::default();
        let mut place_at = |position: Vec3| {
            let next = places.len() as u32;
            // Adding zero turns -0 into +0.
            *places.entry((position + Vec3::ZERO).to_array().map(f32::to_bits)).or_insert(next)
        };
        let place_of: Vec<u32> = scene.vertices.iter().map(|vertex| place_at(vertex.position)).collect();
        let mut touching = vec![0; places.len()];
        for corner in scene.triangles.iter().flat_map(|triangle| triangle.vertices) {
            touching[place_of[corner as usize] as usize] += 1;
        }
        let num_elements = scene.triangles.len();
        let mut levels = vec![None; forest.nodes.len()];
        levels[..num_elements].fill(Some(0));
        let mut coarsening =
            Self { scene, forest, place_of, touching, halved_at: vec![0..0; places.len()], halved: Vec::new(), levels };
        let mut halved: Vec<(u32, u32)> =
            (num_elements..forest.nodes.len()).map(|node| (coarsening.middle_of(node as u32), node as u32)).collect();
        halved.sort_unstable();
        for same in halved.chunk_by(|a, b| a.0 == b.0) {
            let first = coarsening.halved.len() as u32;
            coarsening.halved.extend(same.iter().map(|(_, node)| *node));
            coarsening.halved_at[same[0].0 as usize] = first..coarsening.halved.len() as u32;
        }
        coarsening
    }

    fn halves(&self, node: u32) -> Halves {
        self.forest.nodes[node as usize].halves.expect("only triangles of the mesh have no halves")
    }

    /// Returns the place at which a node is halved.
    fn middle_of(&self, node: u32) -> u32 {
        self.place_of[self.halves(node).middle as usize]
    }

    /// Returns the bits of the length of the edge whose middle is a place. They have the same order as the lengths.
    fn length_at(&self, place: u32) -> u32 {
        let node = self.halved[self.halved_at[place as usize].start as usize];
        let [_, from, to] = self.forest.nodes[node as usize].corners.map(|v| self.scene.vertices[v as usize].position);
        from.distance(to).to_bits()
    }

    /// Joins all halves at a place if that is possible, and returns the parents of the joined nodes.
    fn remove(&mut self, place: u32, texels_per_element: u64) -> Vec<u32> {
        let range = self.halved_at[place as usize].clone();
        let nodes = self.halved[range.start as usize..range.end as usize].to_vec();
        let is_whole = |node: u32| self.levels[node as usize].is_some();
        let are_halves_whole = nodes.iter().all(|&node| self.halves(node).nodes.into_iter().all(is_whole));
        if !are_halves_whole || self.touching[place as usize] != 2 * nodes.len() as u32 {
            return Vec::new();
        }
        let levels: Vec<u32> = nodes.iter().map(|&node| self.level(node)).collect();
        let texels: u64 = levels.iter().map(|&level| num_texels(level.min(FINEST))).sum();
        let elements: u64 = nodes.iter().map(|&node| u64::from(self.forest.nodes[node as usize].num_elements)).sum();
        if texels > texels_per_element * elements || levels.iter().any(|&level| level > MAX_LEVEL) {
            return Vec::new();
        }
        self.touching[place as usize] = 0;
        for (&node, level) in nodes.iter().zip(levels) {
            self.halves(node).nodes.into_iter().for_each(|half| self.levels[half as usize] = None);
            self.levels[node as usize] = Some(level);
            let apex = self.forest.nodes[node as usize].corners[0];
            self.touching[self.place_of[apex as usize] as usize] -= 1;
        }
        nodes.into_iter().filter_map(|node| self.forest.parents[node as usize]).collect()
    }

    /// Returns the level of the grid of a node: the coarsest on which all corners of its elements lie.
    fn level(&self, node: u32) -> u32 {
        let mut odd = 0;
        let corners = [IVec2::ZERO, IVec2::new(1 << FINEST, 0), IVec2::new(0, 1 << FINEST)];
        self.forest.visit(node, corners, &mut |_, corners| {
            for corner in corners {
                odd |= corner.x | corner.y;
            }
        });
        FINEST.saturating_sub(odd.trailing_zeros())
    }
}
