//! Sorts triangles into compact chunks of fixed size, which are culled as a whole.
//!
//! Source: MacDonald and Booth 1990, "Heuristics for Ray Tracing Using Space Subdivision" (the surface area heuristic).

use glam::Vec3;
use rayon::prelude::*;

use crate::base::bounds::Bounds;
use crate::base::ids::TriangleId;

/// Triangles per chunk.
pub const CHUNK: usize = 64;

/// Returns a spatial order of triangles: each run of [`CHUNK`] triangles is a compact chunk, and neighbouring chunks
/// are near each other.
pub fn spatial_order(
    corners: impl Fn(TriangleId) -> [Vec3; 3],
    triangles: impl Iterator<Item = TriangleId>,
) -> Vec<TriangleId> {
    let placed = |id: TriangleId| {
        let corners = corners(id);
        let bounds = Bounds::of(corners.into_iter());
        Placed { id, bounds, centroid: corners.into_iter().sum::<Vec3>() / 3.0 }
    };
    let mut triangles: Vec<Placed> = triangles.map(placed).collect();
    sort(&mut triangles);
    triangles.into_iter().map(|triangle| triangle.id).collect()
}

/// Returns the bounds of the chunks of triangles in this order.
pub fn chunk_bounds(corners: impl Fn(TriangleId) -> [Vec3; 3], order: &[TriangleId]) -> Vec<Bounds> {
    order.chunks(CHUNK).map(|chunk| Bounds::of(chunk.iter().flat_map(|&t| corners(t)))).collect()
}

#[derive(Clone, Copy)]
struct Placed {
    id: TriangleId,
    bounds: Bounds,
    centroid: Vec3,
}

/// Splits the triangles recursively in two, each time at the multiple of [`CHUNK`] with the least cost by the surface
/// area heuristic.
fn sort(triangles: &mut [Placed]) {
    if triangles.len() <= CHUNK {
        return;
    }
    let mut best = (f32::INFINITY, 0, CHUNK);
    for axis in 0..3 {
        sort_along(triangles, axis);
        let costs = costs(triangles);
        let (cut, &cost) = costs.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1)).expect("two chunks");
        if cost < best.0 {
            best = (cost, axis, (cut + 1) * CHUNK);
        }
    }
    let (_, axis, cut) = best;
    sort_along(triangles, axis);
    let (low, high) = triangles.split_at_mut(cut);
    rayon::join(|| sort(low), || sort(high));
}

fn sort_along(triangles: &mut [Placed], axis: usize) {
    triangles.par_sort_unstable_by(|a, b| a.centroid[axis].total_cmp(&b.centroid[axis]).then(a.id.cmp(&b.id)));
}

/// Returns the cost of a split after each chunk but the last: sum over both sides of surface area x number of chunks.
fn costs(triangles: &[Placed]) -> Vec<f32> {
    let chunks: Vec<Bounds> =
        triangles.chunks(CHUNK).map(|chunk| chunk.iter().fold(Bounds::EMPTY, |sum, t| sum.joined(t.bounds))).collect();
    let running = |bounds: &mut dyn Iterator<Item = &Bounds>| -> Vec<f32> {
        let grow = |sum: &mut Bounds, next: &Bounds| {
            *sum = sum.joined(*next);
            Some(sum.half_area())
        };
        bounds.scan(Bounds::EMPTY, grow).collect()
    };
    let (below, above) = (running(&mut chunks.iter()), running(&mut chunks.iter().rev()));
    let num_chunks = chunks.len();
    let cost = |cut: usize| below[cut - 1] * cut as f32 + above[num_chunks - cut - 1] * (num_chunks - cut) as f32;
    (1..num_chunks).map(cost).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::builtin;

    #[test]
    fn chunks_hold_every_triangle_once_and_are_more_compact_than_in_file_order() {
        let scene = builtin::gallery();
        let corners = |t| scene.corners(t);
        let order = spatial_order(corners, (0..scene.triangles.len()).map(TriangleId::new));
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert!(sorted.iter().enumerate().all(|(t, id)| id.index() == t) && sorted.len() == scene.triangles.len());
        let area = |order: &[TriangleId]| -> f32 { chunk_bounds(corners, order).iter().map(Bounds::half_area).sum() };
        assert!(area(&order) < 0.8 * area(&sorted), "{} of {}", area(&order), area(&sorted));
    }
}
