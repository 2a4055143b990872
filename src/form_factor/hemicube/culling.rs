//! Selects what a face draws: skips chunks outside its frustum, and triangles that cover the centre of no pixel.
//!
//! In a finely modelled scene most triangles in view fall between the pixels of a hemicube. A driver rejects them too,
//! but only after it has shaded and set up their corners.

use glam::{BVec4A, Mat4, Vec3, Vec4};

use crate::base::bounds::{Bounds, Frustum};
use crate::base::ids::TriangleId;
use crate::scene::Scene;
use crate::scene::chunks::{CHUNK, chunk_bounds};

/// Triangles tested together.
const LANES: usize = 4;

/// Distance in pixels by which a device may displace a corner: it snaps corners to a sixteenth of a pixel or finer, and
/// rounds.
const DISPLACEMENT: f32 = 1.0 / 32.0 + ROUNDING;
const ROUNDING: f32 = 1.0 / 64.0;

/// Largest rounding error of a clip coordinate (three products and their sum), divided by the largest coordinate of the
/// scene.
const CLIP_ERROR: f32 = 8.0 * f32::EPSILON;

/// Triangles of a scene in the order of their chunks.
pub(super) struct Culling {
    chunks: Vec<Bounds>,
    lanes: Vec<Lanes>,
    /// Largest coordinate of the scene.
    reach: f32,
}

/// Corners of four triangles: `[corner][axis]`. Unused lanes are NaN, which fails every comparison.
type Lanes = [[Vec4; 3]; 3];

/// A chunk that is in view.
struct VisibleChunk {
    distance_squared: f32,
    chunk: usize,
}

impl Culling {
    pub(super) fn new(scene: &Scene, order: &[TriangleId]) -> Self {
        let chunks = chunk_bounds(|t| scene.corners(t), order);
        let lanes =
            order.chunks(LANES).map(|triangles| lanes_of(triangles.iter().map(|t| scene.corners(*t)))).collect();
        let reach = chunks.iter().map(|b| b.low.abs().max(b.high.abs()).max_element()).fold(0.0, f32::max);
        Self { chunks, lanes, reach }
    }

    /// Returns the indices of the corners that a face of `size` pixels draws from `eye`. The nearest chunks come first,
    /// so the depth test rejects most of the others before they are shaded.
    pub(super) fn indices(&self, clip_from_world: &Mat4, eye: Vec3, size: (u32, u32)) -> Vec<u32> {
        let frustum = Frustum::new(clip_from_world);
        let meets = |(chunk, bounds): (usize, &Bounds)| {
            let distance_squared = eye.distance_squared(eye.clamp(bounds.low, bounds.high));
            frustum.meets(bounds).then_some(VisibleChunk { distance_squared, chunk })
        };
        let mut visible: Vec<VisibleChunk> = self.chunks.iter().enumerate().filter_map(meets).collect();
        visible.sort_unstable_by(|a, b| a.distance_squared.total_cmp(&b.distance_squared).then(a.chunk.cmp(&b.chunk)));
        let projection = Projection::new(clip_from_world, size, self.reach);
        let mut indices = Vec::new();
        for VisibleChunk { chunk, .. } in visible {
            const LANES_A_CHUNK: usize = CHUNK / LANES;
            let first = chunk * LANES_A_CHUNK;
            let end = (first + LANES_A_CHUNK).min(self.lanes.len());
            for (i, lanes) in self.lanes[first..end].iter().enumerate() {
                let mut covering = projection.covering(lanes);
                while covering != 0 {
                    let corner = (3 * ((first + i) * LANES) as u32) + 3 * covering.trailing_zeros();
                    indices.extend([corner, corner + 1, corner + 2]);
                    covering &= covering - 1;
                }
            }
        }
        indices
    }
}

fn lanes_of(triangles: impl Iterator<Item = [Vec3; 3]>) -> Lanes {
    let mut lanes = [[Vec4::NAN; 3]; 3];
    for (lane, corners) in triangles.enumerate() {
        for (to, corner) in lanes.iter_mut().zip(corners) {
            for axis in 0..3 {
                to[axis][lane] = corner[axis];
            }
        }
    }
    lanes
}

/// The projection of a face, each number in all lanes.
struct Projection {
    /// Rows x, y and w of the clip-from-world matrix.
    rows: [[Vec4; 4]; 3],
    near: Vec4,
    /// Smallest w at which the projection of a corner is exact enough for the test. Triangles with a nearer corner are
    /// tested against the sides of the frustum only.
    too_near: Vec4,
    /// Half of the width and of the height, pixels.
    half: [Vec4; 2],
}

impl Projection {
    fn new(clip_from_world: &Mat4, (width, height): (u32, u32), reach: f32) -> Self {
        let row = |i: usize| clip_from_world.row(i).to_array().map(Vec4::splat);
        let half = [width, height].map(|size| size as f32 / 2.0);
        // The error of x / w is at most twice that of its parts.
        let too_near = 2.0 * CLIP_ERROR * reach * half[0] / ROUNDING;
        let near = clip_from_world.w_axis.z;
        Self {
            rows: [row(0), row(1), row(3)],
            near: Vec4::splat(near),
            too_near: Vec4::splat(near.max(too_near)),
            half: half.map(Vec4::splat),
        }
    }

    /// Returns the lanes whose triangles may cover the centre of a pixel, as bits: lane 0 is the lowest.
    fn covering(&self, lanes: &Lanes) -> u32 {
        let clip =
            |[x, y, z]: &[Vec4; 3]| self.rows.map(|[to_x, to_y, to_z, offset]| to_x * x + to_y * y + to_z * z + offset);
        let corners = lanes.each_ref().map(clip);
        let w = corners.map(|[_, _, w]| w);
        let (nearest, furthest) = (w[0].min(w[1]).min(w[2]), w[0].max(w[1]).max(w[2]));
        let mut hit = furthest.cmpge(self.near);
        let is_near = nearest.cmple(self.too_near);
        if is_near.any() {
            for axis in 0..2 {
                let p = corners.map(|corner| corner[axis]);
                let below = p[0].cmplt(-w[0]) & p[1].cmplt(-w[1]) & p[2].cmplt(-w[2]);
                let above = p[0].cmpgt(w[0]) & p[1].cmpgt(w[1]) & p[2].cmpgt(w[2]);
                hit &= !(below | above);
            }
        }
        // Corners in pixels, by axis; the centres of pixels are whole numbers.
        let at = [0, 1].map(|axis| corners.map(|p| p[axis] / p[2] * self.half[axis] + (self.half[axis] - 0.5)));
        // First and last pixel centre in the bounding box of the triangle, and whether the box is at most two pixels
        // wide.
        let span = |axis: usize| {
            let [a, b, c] = at[axis];
            let (low, high) = (a.min(b).min(c) - DISPLACEMENT, a.max(b).max(c) + DISPLACEMENT);
            let last = 2.0 * self.half[axis] - 1.0;
            (low.max(Vec4::ZERO).ceil(), high.min(last).floor(), (high - low).cmplt(Vec4::splat(2.0)))
        };
        let [(left, right, is_narrow), (top, bottom, is_low)] = [span(0), span(1)];
        hit &= is_near | (left.cmple(right) & top.cmple(bottom));
        let is_small = is_narrow & is_low;
        if (hit & is_small).any() {
            let covers =
                [[left, top], [left, bottom], [right, top], [right, bottom]].map(|centre| may_hold(&at, centre));
            hit &= is_near | !is_small | covers[0] | covers[1] | covers[2] | covers[3];
        }
        hit.bitmask()
    }
}

/// Returns the lanes whose triangles may contain a point. If a triangle contains the point after its corners were
/// displaced, the original triangle lies within that displacement of the point.
fn may_hold([x, y]: &[[Vec4; 3]; 2], [px, py]: [Vec4; 2]) -> BVec4A {
    let sides: [[Vec4; 2]; 3] = std::array::from_fn(|i| {
        let j = (i + 1) % 3;
        let (dx, dy) = (x[j] - x[i], y[j] - y[i]);
        [dx * (py - y[i]) - dy * (px - x[i]), (dx.abs() + dy.abs()) * DISPLACEMENT]
    });
    let all = |inside: &dyn Fn([Vec4; 2]) -> BVec4A| inside(sides[0]) & inside(sides[1]) & inside(sides[2]);
    all(&|[side, slack]| side.cmpge(-slack)) | all(&|[side, slack]| side.cmple(slack))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::sampling::{hash, unit_float};
    use crate::form_factor::Viewpoint;
    use crate::form_factor::hemicube::faces::{cell_rectangle, projections};

    /// A random triangle near the origin. Sizes range from less than a pixel to more than a face.
    fn triangle(seed: u32) -> [Vec3; 3] {
        let number = |i: u32| unit_float(hash(16 * seed + i));
        let random = |i: u32| Vec3::new(number(i), number(i + 1), number(i + 2)) * 2.0 - 1.0;
        let size = (0.002f32).powf(number(0));
        [1, 4, 7].map(|i| 4.0 * random(10) + size * random(i))
    }

    /// Returns true if a triangle in front of the eye covers the centre of a pixel, in double precision.
    fn covers(matrix: &Mat4, (width, height): (u32, u32), corners: [Vec3; 3]) -> bool {
        let clip = corners.map(|p| matrix.as_dmat4() * p.as_dvec3().extend(1.0));
        let [a, b, c] = clip.map(|p| [p.x / p.w, p.y / p.w]);
        let centre = |i: u32, size: u32| (2.0 * f64::from(i) + 1.0) / f64::from(size) - 1.0;
        let side = |p: [f64; 2], q: [f64; 2], x: f64, y: f64| (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
        let holds = |x: f64, y: f64| {
            let sides = [side(a, b, x, y), side(b, c, x, y), side(c, a, x, y)];
            sides.iter().all(|&s| s >= 0.0) || sides.iter().all(|&s| s <= 0.0)
        };
        (0..height).any(|j| (0..width).any(|i| holds(centre(i, width), centre(j, height))))
    }

    #[test]
    fn triangles_that_cover_a_pixel_are_kept_and_most_others_culled() {
        let viewpoint = Viewpoint { position: Vec3::ZERO, normal: Vec3::new(0.6, 0.0, 0.8), seed: 3 };
        const NEAR: f32 = 1e-5;
        let (mut needless, mut empty) = (0, 0);
        for (face, matrix) in projections(&viewpoint, NEAR).iter().enumerate() {
            let (width, height, _) = cell_rectangle(face, 32);
            let tested = Projection::new(matrix, (width, height), 5.0);
            for corners in (0..2000).map(triangle) {
                let kept = tested.covering(&lanes_of(std::iter::once(corners))) == 1;
                let in_front = corners.iter().all(|p| (*matrix * p.extend(1.0)).w > 0.1);
                let is_behind = corners.iter().all(|p| (*matrix * p.extend(1.0)).w < 0.0);
                assert!(!(kept && is_behind), "{corners:?}");
                if in_front {
                    let covers = covers(matrix, (width, height), corners);
                    assert!(kept || !covers, "face {face}: {corners:?}");
                    empty += u32::from(!covers);
                    needless += u32::from(kept && !covers);
                }
            }
        }
        assert!(empty > 1000 && 10 * needless < empty, "{needless} of {empty}");
    }
}
