//! Draws the light of elements into texels.

use std::collections::{BTreeMap, VecDeque};

use glam::{DVec2, Vec3, Vec4, Vec4Swizzles as _};

use super::pieces::Piece;
use crate::baked::Texels;

/// Number of sample points across and down a texel.
const POINTS: i64 = 4;

/// Draws all pieces.
pub(super) fn draw<'a, Pieces: Iterator<Item = Piece>>(size: [u32; 2], pieces: impl Fn() -> Pieces + 'a) -> Texels {
    let mut canvas = Canvas::new(size);
    pieces().for_each(|piece| canvas.add_area(&piece));
    let mut touched = BTreeMap::new();
    pieces().for_each(|piece| canvas.touch(&piece, &mut touched));
    for (texel, sum) in touched {
        canvas.sums[texel] = sum;
    }
    canvas.spread();
    let irradiance = canvas.sums.iter().map(|sum| mean(*sum)).collect();
    Texels { width: size[0], height: size[1], irradiance }
}

/// Sums of light (x, y, z) and their number (w), texel by texel.
struct Canvas {
    width: i64,
    height: i64,
    sums: Vec<Vec4>,
}

fn mean(sum: Vec4) -> Vec3 {
    sum.xyz() / sum.w.max(1.0)
}

impl Canvas {
    fn new([width, height]: [u32; 2]) -> Self {
        let (width, height) = (i64::from(width), i64::from(height));
        Self { width, height, sums: vec![Vec4::ZERO; (width * height) as usize] }
    }

    /// Adds the light at all sample points in the piece.
    fn add_area(&mut self, piece: &Piece) {
        let corners = piece.corners.map(|corner| corner * POINTS as f64);
        let doubled_area = cross(corners[1] - corners[0], corners[2] - corners[0]);
        if doubled_area == 0.0 {
            return;
        }
        let (low, high) = bounds(corners);
        let rows = grid_range(low.y, high.y, self.height * POINTS);
        let columns = grid_range(low.x, high.x, self.width * POINTS);
        for y in rows {
            for x in columns.clone() {
                let point = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                let weight =
                    |from: usize, to: usize| cross(corners[to] - corners[from], point - corners[from]) / doubled_area;
                let weights = [weight(1, 2), weight(2, 0), weight(0, 1)];
                if weights.iter().all(|&weight| weight >= 0.0) {
                    let light = (0..3).map(|k| piece.light[k] * weights[k] as f32).sum::<Vec3>();
                    self.sums[((y / POINTS) * self.width + x / POINTS) as usize] += light.extend(1.0);
                }
            }
        }
    }

    /// Texels that a piece touches without covering a sample point, as at the tip of a sliver, take the light of the
    /// edges in them.
    fn touch(&self, piece: &Piece, touched: &mut BTreeMap<usize, Vec4>) {
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            let (start, end) = (piece.corners[from], piece.corners[to]);
            let steps = (2.0 * start.distance(end)).ceil().max(1.0) as u32;
            for step in 0..=steps {
                let share = f64::from(step) / f64::from(steps);
                let texel = self.texel_at(start.lerp(end, share));
                if self.sums[texel].w == 0.0 {
                    let light = piece.light[from].lerp(piece.light[to], share as f32);
                    *touched.entry(texel).or_default() += light.extend(1.0);
                }
            }
        }
    }

    fn texel_at(&self, at: DVec2) -> usize {
        let (x, y) = ((at.x as i64).clamp(0, self.width - 1), (at.y as i64).clamp(0, self.height - 1));
        (y * self.width + x) as usize
    }

    /// Fills texels that nothing covers with the light of the nearest ones, ring by ring, so that neither filtering nor
    /// mip maps darken surfaces.
    fn spread(&mut self) {
        let is_lit = |sums: &[Vec4], texel: usize| sums[texel].w > 0.0;
        let mut edge: VecDeque<usize> = (0..self.sums.len()).filter(|&texel| is_lit(&self.sums, texel)).collect();
        while !edge.is_empty() {
            let mut ring = BTreeMap::new();
            for texel in edge {
                let light = mean(self.sums[texel]).extend(1.0);
                for neighbour in self.neighbours(texel).filter(|&neighbour| !is_lit(&self.sums, neighbour)) {
                    *ring.entry(neighbour).or_insert(Vec4::ZERO) += light;
                }
            }
            ring.iter().for_each(|(&texel, &sum)| self.sums[texel] = sum);
            edge = ring.into_keys().collect();
        }
    }

    /// The up to eight neighbours of a texel.
    fn neighbours(&self, texel: usize) -> impl Iterator<Item = usize> + use<> {
        let (width, height) = (self.width, self.height);
        let (x, y) = (texel as i64 % width, texel as i64 / width);
        let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy)));
        around.map(move |(dx, dy)| (x + dx, y + dy)).filter_map(move |(x, y)| {
            ((0..width).contains(&x) && (0..height).contains(&y)).then_some((y * width + x) as usize)
        })
    }
}

fn cross(a: DVec2, b: DVec2) -> f64 {
    a.perp_dot(b)
}

fn bounds([a, b, c]: [DVec2; 3]) -> (DVec2, DVec2) {
    (a.min(b).min(c), a.max(b).max(c))
}

/// Indices of the sample points, which lie at half numbers, between two positions.
fn grid_range(low: f64, high: f64, size: i64) -> std::ops::Range<i64> {
    let first = (low - 0.5).ceil() as i64;
    let last = (high - 0.5).floor() as i64;
    first.clamp(0, size)..(last + 1).clamp(0, size)
}
