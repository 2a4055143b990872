//! Defects where triangles meet: open edges, opposite windings, T-junctions, duplicates.

use std::collections::HashMap;

use glam::{IVec3, Vec3};

use super::finding::{Finding, FindingKind, Location};
use super::weld::Welded;

/// Distance below which a vertex counts as on an edge, as a share of the scene's diagonal: a few units of rounding.
const ON_EDGE: f32 = 4e-6;

/// Largest number of steps along one edge in the search grid.
const MAX_STEPS: usize = 4096;

/// Finds triangles with the same three vertices and the same front. All but the first of each set are reported.
pub(super) fn duplicates(welded: &Welded) -> Finding {
    let from_smallest = |i: usize| {
        let [a, b, c] = welded.triangles[i];
        ([[a, b, c], [b, c, a], [c, a, b]].into_iter().min().unwrap_or_default(), i)
    };
    let mut sorted: Vec<_> = (0..welded.triangles.len()).map(from_smallest).collect();
    sorted.sort_unstable();
    let doubles = sorted.windows(2).filter(|pair| pair[0].0 == pair[1].0).map(|pair| pair[1].1);
    Finding::counted(FindingKind::DuplicateTriangle, doubles.map(|i| Location::triangle(welded.corners(i))))
}

/// An edge: the indices of its welded end points, the smaller one first.
type Edge = [u32; 2];

/// Defective edges, by the way in which triangles share them.
#[derive(Default)]
pub(super) struct Edges {
    open: Vec<Edge>,
    non_manifold: Vec<Edge>,
    flipped: Vec<Edge>,
}

impl Edges {
    /// Classifies the edges of all triangles.
    pub fn new(welded: &Welded) -> Self {
        let directed = welded.triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
        let mut uses: Vec<_> = directed.map(|(a, b)| ([a.min(b), a.max(b)], a < b)).collect();
        uses.sort_unstable();
        let mut edges = Self::default();
        for uses in uses.chunk_by(|x, y| x.0 == y.0) {
            match uses {
                [(edge, _)] => edges.open.push(*edge),
                [first, second] if first.1 == second.1 => edges.flipped.push(first.0),
                [_, _] | [] => {}
                [(edge, _), ..] => edges.non_manifold.push(*edge),
            }
        }
        edges
    }

    /// Returns the findings about edges that follow from the number of their triangles.
    pub fn findings(&self, welded: &Welded) -> [Finding; 3] {
        let shown = |kind, edges: &[Edge]| {
            let ends = |edge: &Edge| Location::segment(edge.map(|w| welded.positions[w as usize]));
            Finding::counted(kind, edges.iter().map(ends))
        };
        [
            shown(FindingKind::OpenEdge, &self.open),
            shown(FindingKind::NonManifoldEdge, &self.non_manifold),
            shown(FindingKind::FlippedWinding, &self.flipped),
        ]
    }

    /// Finds vertices of open edges that lie inside another open edge. Two triangles meet a third there, and rounding
    /// opens cracks through which light or background shines.
    pub fn t_junctions(&self, welded: &Welded, diagonal: f32) -> Finding {
        let tolerance = ON_EDGE * diagonal;
        let grid = Grid::new(&self.open, welded, tolerance);
        let mut found = Vec::new();
        for &edge in &self.open {
            grid.near(edge, welded, |w| {
                let at = welded.positions[w as usize];
                if lies_inside(at, edge.map(|end| welded.positions[end as usize]), tolerance) {
                    found.push(w);
                }
            });
        }
        found.sort_unstable();
        found.dedup();
        Finding::counted(
            FindingKind::TJunction,
            found.into_iter().map(|w| Location::segment([welded.positions[w as usize]; 2])),
        )
    }
}

/// Returns true if a point lies on an edge, but not at its ends.
fn lies_inside(point: Vec3, [a, b]: [Vec3; 2], tolerance: f32) -> bool {
    let along = (b - a).normalize_or_zero();
    let t = (point - a).dot(along);
    let is_between = t > tolerance && t < a.distance(b) - tolerance;
    is_between && (a + along * t).distance(point) <= tolerance
}

/// End points of open edges in a hash grid.
struct Grid {
    cell: f32,
    ends: HashMap<IVec3, Vec<u32>>,
}

impl Grid {
    /// Inserts the end points into cells whose side is the mean length of the open edges.
    fn new(open: &[Edge], welded: &Welded, tolerance: f32) -> Self {
        let length = |edge: &Edge| {
            let [a, b] = edge.map(|w| welded.positions[w as usize]);
            a.distance(b)
        };
        let mean = open.iter().map(length).sum::<f32>() / open.len().max(1) as f32;
        let mut grid = Self { cell: mean.max(4.0 * tolerance).max(f32::MIN_POSITIVE), ends: HashMap::new() };
        let mut ends: Vec<u32> = open.iter().flatten().copied().collect();
        ends.sort_unstable();
        ends.dedup();
        for w in ends {
            grid.ends.entry(grid.cell_of(welded.positions[w as usize])).or_default().push(w);
        }
        grid
    }

    fn cell_of(&self, point: Vec3) -> IVec3 {
        (point / self.cell).floor().as_ivec3()
    }

    /// Calls `visit` with every end point near an edge except the edge's own, possibly more than once.
    fn near(&self, edge: Edge, welded: &Welded, mut visit: impl FnMut(u32)) {
        let [a, b] = edge.map(|w| welded.positions[w as usize]);
        let num_steps = ((a.distance(b) / self.cell).ceil() as usize).clamp(1, MAX_STEPS);
        let mut cells: Vec<IVec3> = Vec::new();
        for step in 0..=num_steps {
            let centre = self.cell_of(a.lerp(b, step as f32 / num_steps as f32));
            let neighbours = (0..27).map(|i| centre.wrapping_add(IVec3::new(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)));
            cells.extend(neighbours);
        }
        cells.sort_unstable_by_key(|cell| cell.to_array());
        cells.dedup();
        let ends = cells.iter().filter_map(|cell| self.ends.get(cell)).flatten();
        ends.copied().filter(|w| !edge.contains(w)).for_each(&mut visit);
    }
}
