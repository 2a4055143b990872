//! Coplanar surfaces that overlap. They flicker when drawn, and each receives light as if the other did not exist.

use std::collections::HashMap;

use glam::{DVec2, DVec3};

use super::finding::{Finding, FindingKind, Location};
use super::weld::Welded;

/// Distance below which two planes count as the same, as a share of the scene's diagonal.
const SAME_PLANE: f64 = 1e-6;

/// Smallest overlap that counts, as a share of the smaller triangle's area; triangles that only touch stay below it.
const MIN_SHARE: f64 = 1e-3;

/// Largest number of pairs of triangles that are compared; bounds the time that a degenerate mesh takes.
const MAX_PAIRS: usize = 20_000_000;

/// Largest number of cells of the search grid of one plane.
const MAX_CELLS: f64 = 2e6;

/// A triangle in the coordinates of its plane.
struct Flat {
    index: usize,
    corners: [DVec2; 3],
    low: DVec2,
    high: DVec2,
}

/// Finds coplanar triangles that overlap. Exact duplicates are a finding of their own.
pub(super) fn overlaps(welded: &Welded, diagonal: f32) -> Finding {
    let tolerance = SAME_PLANE * f64::from(diagonal).max(f64::MIN_POSITIVE);
    let mut involved = Vec::new();
    let mut pairs_left = MAX_PAIRS;
    for triangles in planes(welded, tolerance).into_values().filter(|triangles| triangles.len() > 1) {
        overlaps_in_plane(welded, &triangles, &mut pairs_left, &mut involved);
    }
    involved.sort_unstable();
    involved.dedup();
    Finding::counted(FindingKind::CoplanarOverlap, involved.into_iter().map(|i| Location::triangle(welded.corners(i))))
}

/// Groups triangles by plane. Each is entered in two grids of distances, shifted by half a cell, so rounding of the
/// distance cannot separate coplanar triangles.
fn planes(welded: &Welded, tolerance: f64) -> HashMap<([i32; 3], i64, bool), Vec<usize>> {
    let mut planes: HashMap<_, Vec<usize>> = HashMap::new();
    for i in 0..welded.triangles.len() {
        let [a, b, c] = welded.corners(i).map(|corner| corner.as_dvec3());
        let normal = facing_up((b - a).cross(c - a).normalize_or_zero());
        let direction = (normal * 1e4).round().as_ivec3().to_array();
        let distance = normal.dot(a) / tolerance;
        for is_shifted in [false, true] {
            let bucket = (distance + if is_shifted { 0.5 } else { 0.0 }).floor() as i64;
            planes.entry((direction, bucket, is_shifted)).or_default().push(i);
        }
    }
    planes
}

/// Returns the normal or its opposite, whichever has a positive first non-zero component.
fn facing_up(normal: DVec3) -> DVec3 {
    let leading = normal.to_array().into_iter().find(|x| x.abs() > 1e-6).unwrap_or(1.0);
    if leading < 0.0 { -normal } else { normal }
}

fn overlaps_in_plane(welded: &Welded, triangles: &[usize], pairs_left: &mut usize, involved: &mut Vec<usize>) {
    let flats = flatten(welded, triangles);
    let extent = flats.iter().map(|flat| (flat.high - flat.low).max_element()).sum::<f64>() / flats.len() as f64;
    let cell = extent.max(f64::MIN_POSITIVE);
    let mut grid: HashMap<[i64; 2], Vec<usize>> = HashMap::new();
    let mut cells_left = MAX_CELLS;
    for (f, flat) in flats.iter().enumerate() {
        let [low, high] = [flat.low, flat.high].map(|corner| (corner / cell).floor());
        cells_left -= (high - low + 1.0).element_product();
        if cells_left < 0.0 {
            return;
        }
        for x in low.x as i64..=high.x as i64 {
            for y in low.y as i64..=high.y as i64 {
                grid.entry([x, y]).or_default().push(f);
            }
        }
    }
    for cell in grid.values() {
        for (n, &f) in cell.iter().enumerate() {
            for &g in &cell[n + 1..] {
                *pairs_left = pairs_left.saturating_sub(1);
                if *pairs_left == 0 {
                    return;
                }
                if are_duplicates(welded, flats[f].index, flats[g].index) || !boxes_meet(&flats[f], &flats[g]) {
                    continue;
                }
                let shared = common_area(flats[f].corners, flats[g].corners);
                if shared > MIN_SHARE * area(&flats[f].corners).min(area(&flats[g].corners)) {
                    involved.extend([flats[f].index, flats[g].index]);
                }
            }
        }
    }
}

/// Projects triangles to two coordinates of the first one's plane, wound counter-clockwise.
fn flatten(welded: &Welded, triangles: &[usize]) -> Vec<Flat> {
    let [a, b, c] = welded.corners(triangles[0]).map(|corner| corner.as_dvec3());
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let (u, v) = normal.any_orthonormal_pair();
    let flat = |&index: &usize| {
        let mut corners = welded.corners(index).map(|corner| {
            let from_first = corner.as_dvec3() - a;
            DVec2::new(from_first.dot(u), from_first.dot(v))
        });
        if (corners[1] - corners[0]).perp_dot(corners[2] - corners[0]) < 0.0 {
            corners.swap(1, 2);
        }
        let [p, q, r] = corners;
        Flat { index, corners, low: p.min(q).min(r), high: p.max(q).max(r) }
    };
    triangles.iter().map(flat).collect()
}

fn are_duplicates(welded: &Welded, i: usize, j: usize) -> bool {
    let sorted = |i: usize| {
        let mut corners = welded.triangles[i];
        corners.sort_unstable();
        corners
    };
    i == j || sorted(i) == sorted(j)
}

fn boxes_meet(a: &Flat, b: &Flat) -> bool {
    a.low.cmplt(b.high).all() && b.low.cmplt(a.high).all()
}

/// Returns the area of the intersection of two triangles: one is clipped at the sides of the other.
///
/// Source: Sutherland and Hodgman 1974, "Reentrant Polygon Clipping".
fn common_area(subject: [DVec2; 3], clip: [DVec2; 3]) -> f64 {
    let mut polygon = subject.to_vec();
    for side in 0..3 {
        let (a, b) = (clip[side], clip[(side + 1) % 3]);
        let height = |p: DVec2| (b - a).perp_dot(p - a);
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (i, &p) in polygon.iter().enumerate() {
            let q = polygon[(i + 1) % polygon.len()];
            let (hp, hq) = (height(p), height(q));
            if hp >= 0.0 {
                kept.push(p);
            }
            if (hp >= 0.0) != (hq >= 0.0) {
                kept.push(p.lerp(q, hp / (hp - hq)));
            }
        }
        polygon = kept;
        if polygon.len() < 3 {
            return 0.0;
        }
    }
    area(&polygon)
}

fn area(polygon: &[DVec2]) -> f64 {
    let crossed = |i: usize| polygon[i].perp_dot(polygon[(i + 1) % polygon.len()]);
    0.5 * (0..polygon.len()).map(crossed).sum::<f64>()
}
