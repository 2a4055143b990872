//! Casters: the opaque triangles of a scene, joined at their edges.
//!
//! Files split vertices at seams, leave meshes open, let three faces share an edge, turn some faces over and end edges
//! in the middle of longer ones (T-junctions). A shadow volume is closed nevertheless if each edge sums the triangles
//! on it with the sign of their direction (Kim, Kim and Turk 2008, "A shadow-volume algorithm for opaque and
//! transparent nonmanifold casters"; see `volume/hull.rs`). So corners are welded by position, and an edge is cut where
//! other corners lie on it. Casters with holes and casters that blend are in `cutout/`.

use std::collections::HashMap;

use glam::Vec3;

use crate::base::ids::InstanceId;
use crate::scene::{AlphaMode, Scene, edge_cross};

/// Largest distance between an edge and a corner at which the corner counts as lying on the edge, as a share of the
/// scene's extent.
const ON_EDGE: f32 = 2e-6;

/// Opaque triangles, which throw shadows, and their edges.
#[derive(Clone, Debug, Default)]
pub struct Casters {
    /// Positions of the welded corners `[v]`, metres.
    pub positions: Vec<Vec3>,
    /// The triangles `[t]`.
    pub triangles: Vec<Caster>,
    /// Parts of triangles, as corners: the triangle itself, and a sliver for each corner that lies on one of its edges.
    /// Slivers close the volume at T-junctions. The triangle is not subdivided, so its depth stays exact.
    pub parts: Vec<[u32; 3]>,
    /// Edges of the triangles `[e]`, each once.
    pub edges: Vec<Edge>,
    /// Triangles at the edges, ordered by edge.
    pub sides: Vec<Side>,
}

/// A triangle that throws a shadow.
#[derive(Clone, Debug, PartialEq)]
pub struct Caster {
    /// Indices of its corners, counter-clockwise seen from the front.
    pub corners: [u32; 3],
    /// Range of its parts in [`Casters::parts`].
    pub parts: std::ops::Range<u32>,
    /// Shading normals at the corners.
    pub normals: [Vec3; 3],
    /// True if its back is invisible when backs are culled. It throws a shadow from both sides.
    pub is_single_sided: bool,
    /// Instance that it belongs to.
    pub instance: InstanceId,
}

/// Two corners and the triangles that share the edge between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge {
    /// Corners at its ends, the lower index first.
    pub ends: [u32; 2],
    /// Range of its triangles in [`Casters::sides`].
    pub sides: std::ops::Range<u32>,
}

/// A triangle at an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side {
    /// Index of the triangle.
    pub triangle: u32,
    /// +1 if the triangle's outline runs along the edge from its first end to its second, else -1.
    pub direction: i32,
}

impl Casters {
    /// Collects all opaque triangles of a scene that have an area, and joins them at their edges.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let mut casters = Self::default();
        let mut index_of: HashMap<[u32; 3], u32> = HashMap::new();
        for id in scene.fronts() {
            let (triangle, material) = (&scene.triangles[id.index()], scene.material_of(id));
            let positions = scene.corners(id);
            if material.alpha_mode != AlphaMode::Opaque || edge_cross(positions) == Vec3::ZERO {
                continue;
            }
            let corners = positions.map(|position| {
                // Adding zero turns -0 into 0.
                let bits = (position + Vec3::ZERO).to_array().map(f32::to_bits);
                *index_of.entry(bits).or_insert_with(|| {
                    casters.positions.push(position);
                    casters.positions.len() as u32 - 1
                })
            });
            let is_single_sided = !material.double_sided;
            let normals = triangle.vertices.map(|vertex| scene.vertices[vertex as usize].normal);
            casters.triangles.push(Caster {
                corners,
                parts: 0..0,
                normals,
                is_single_sided,
                instance: triangle.instance,
            });
        }
        let cuts = casters.cuts(ON_EDGE * scene.bounds().extent());
        casters.join(&cuts);
        casters
    }

    /// Returns for each edge the corners that lie within it, from the end with the lower index to the other.
    fn cuts(&self, tolerance: f32) -> HashMap<[u32; 2], Vec<u32>> {
        let mut uses: HashMap<[u32; 2], u32> = HashMap::new();
        for triangle in &self.triangles {
            for ends in edges_of(&triangle.corners) {
                *uses.entry(sorted(ends)).or_default() += 1;
            }
        }
        // Two triangles share a whole edge. At a T-junction each edge belongs to an odd number of triangles.
        let odd: Vec<[u32; 2]> = uses.into_iter().filter(|(_, uses)| uses % 2 == 1).map(|(ends, _)| ends).collect();
        let mut corners: Vec<u32> = odd.iter().flatten().copied().collect();
        corners.sort_unstable_by(|&a, &b| self.at(a).x.total_cmp(&self.at(b).x).then(a.cmp(&b)));
        corners.dedup();
        odd.into_iter()
            .map(|ends| (ends, self.corners_on(ends, &corners, tolerance)))
            .filter(|(_, on_edge)| !on_edge.is_empty())
            .collect()
    }

    /// Returns those of `corners` (sorted by x) that lie within an edge, from its first end to its second.
    fn corners_on(&self, [a, b]: [u32; 2], corners: &[u32], tolerance: f32) -> Vec<u32> {
        let (from, to) = (self.at(a), self.at(b));
        let (length, along) = ((to - from).length(), (to - from).normalize_or_zero());
        let (low, high) = (from.x.min(to.x) - tolerance, from.x.max(to.x) + tolerance);
        let first = corners.partition_point(|&corner| self.at(corner).x < low);
        let mut found: Vec<(f32, u32)> = corners[first..]
            .iter()
            .take_while(|&&corner| self.at(corner).x <= high)
            .map(|&corner| (self.at(corner) - from, corner))
            .filter(|(offset, _)| offset.reject_from_normalized(along).length() <= tolerance)
            .map(|(offset, corner)| (offset.dot(along), corner))
            .filter(|&(distance, corner)| {
                distance > tolerance && distance < length - tolerance && corner != a && corner != b
            })
            .collect();
        found.sort_by(|x, y| x.0.total_cmp(&y.0));
        found.into_iter().map(|(_, corner)| corner).collect()
    }

    /// Cuts edges at the corners on them, adds slivers for the gaps that this opens, and collects the edges.
    fn join(&mut self, cuts: &HashMap<[u32; 2], Vec<u32>>) {
        let mut sides: Vec<([u32; 2], Side)> = Vec::new();
        let mut add_side = |triangle: usize, ends: [u32; 2]| {
            let direction = if ends[0] < ends[1] { 1 } else { -1 };
            sides.push((sorted(ends), Side { triangle: triangle as u32, direction }));
        };
        for t in 0..self.triangles.len() {
            let first = self.parts.len() as u32;
            let corners = self.triangles[t].corners;
            self.parts.push(corners);
            for [from, to] in edges_of(&corners) {
                let mut last = from;
                for corner in corners_between(from, to, cuts) {
                    add_side(t, [last, corner]);
                    self.parts.push([last, corner, to]);
                    last = corner;
                }
                add_side(t, [last, to]);
            }
            self.triangles[t].parts = first..self.parts.len() as u32;
        }
        sides.sort_unstable_by_key(|(ends, side)| (*ends, side.triangle));
        for same in sides.chunk_by(|a, b| a.0 == b.0) {
            let first = self.sides.len() as u32;
            self.sides.extend(same.iter().map(|(_, side)| *side));
            self.edges.push(Edge { ends: same[0].0, sides: first..self.sides.len() as u32 });
        }
    }

    fn at(&self, corner: u32) -> Vec3 {
        self.positions[corner as usize]
    }

    /// Returns a triangle's parts, as corners.
    #[must_use]
    pub fn parts(&self, triangle: &Caster) -> &[[u32; 3]] {
        &self.parts[triangle.parts.start as usize..triangle.parts.end as usize]
    }

    /// Returns the corner positions of a triangle, metres.
    #[must_use]
    pub fn corners(&self, triangle: &Caster) -> [Vec3; 3] {
        triangle.corners.map(|corner| self.at(corner))
    }
}

/// Returns the corners that lie on an edge, in order from one end to the other.
fn corners_between(from: u32, to: u32, cuts: &HashMap<[u32; 2], Vec<u32>>) -> Vec<u32> {
    let mut corners = cuts.get(&sorted([from, to])).cloned().unwrap_or_default();
    if from > to {
        corners.reverse();
    }
    corners
}

fn edges_of(&[a, b, c]: &[u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
