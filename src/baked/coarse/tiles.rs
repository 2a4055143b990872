//! Tiles: where in a texture the light of each coarse triangle is stored, and to which element each texel belongs.
//!
//! A tile is a square grid with the corners of its triangle at (0, 0), (n, 0) and (0, n), so that corners of elements
//! lie on texels and bilinear interpolation between them shows the same as interpolation on the elements. At the long
//! side bilinear interpolation reads a texel beyond it, which is extrapolated from three texels:
//!
//! t(x, y) = t(x - 1, y) + t(x, y - 1) - t(x - 1, y - 1)
//!
//! Light is then linear between two texels of an edge, and equal on both sides of the edge. Each tile has a margin of
//! one texel, because devices round the weights of interpolation.
//!
//! Source: Bastos, Goslin, Zhang 1997, "Efficient rendering of radiosity using textures and bicubic reconstruction".

use glam::{IVec2, UVec2};

use super::bisection::Forest;
use super::coarsen::{MAX_LEVEL, Whole, num_texels};

/// Marks a texel without an element, as in shaders/stored_light/light_tiles.wgsl.
pub(crate) const NOTHING: u32 = u32::MAX;
/// The width of a texture is a multiple of this.
const STEP: u32 = 64;
/// Smallest width of a texture, in which the largest tile fits.
const MIN_SIDE: u32 = num_texels(MAX_LEVEL).isqrt() as u32;

/// A square texture of tiles.
#[derive(Debug, Default)]
pub(super) struct Layout {
    /// Width and height, texels.
    pub side: u32,
    /// The texel of each tile's first corner.
    pub origins: Vec<UVec2>,
}

impl Layout {
    /// Arranges tiles of these levels in rows, the largest first.
    pub fn new(wholes: &[Whole]) -> Self {
        let mut order: Vec<usize> = (0..wholes.len()).collect();
        order.sort_by_key(|&tile| std::cmp::Reverse(wholes[tile].level));
        let num_texels: u64 = wholes.iter().map(|whole| num_texels(whole.level)).sum();
        let mut layout = Self { side: num_texels.isqrt() as u32, origins: vec![UVec2::ZERO; wholes.len()] };
        layout.side = layout.side.max(MIN_SIDE).next_multiple_of(STEP);
        while layout.place(wholes, &order) > layout.side {
            layout.side += STEP;
        }
        layout
    }

    /// Arranges tiles in this order and returns the height of all rows.
    fn place(&mut self, wholes: &[Whole], order: &[usize]) -> u32 {
        let (mut next, mut height) = (UVec2::ZERO, 0);
        for &tile in order {
            let side = (1 << wholes[tile].level) + 3;
            if height == 0 || next.x + side > self.side {
                next = UVec2::new(0, height);
                height += side;
            }
            self.origins[tile] = next + 1;
            next.x += side;
        }
        height
    }
}

/// An element in a tile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TileElement {
    /// Triangle of the mesh.
    pub triangle: u32,
    /// Texels of its corners.
    pub corners: [UVec2; 3],
}

/// The elements of all tiles, and the element of each texel.
#[derive(Debug, Default)]
pub(super) struct Filling {
    width: u32,
    pub elements: Vec<TileElement>,
    /// Index of the element of each texel, row by row.
    pub element_of: Vec<u32>,
    /// Texels beyond the long side of a tile, next to two texels on it.
    pub beyond: Vec<UVec2>,
}

impl Filling {
    /// Scan-converts the elements.
    pub fn new(forest: &Forest, wholes: &[Whole], layout: &Layout) -> Self {
        let num_texels = (layout.side as usize).pow(2);
        let element_of = vec![NOTHING; num_texels];
        let mut filling = Self { width: layout.side, elements: Vec::new(), element_of, beyond: Vec::new() };
        for (whole, origin) in wholes.iter().zip(&layout.origins) {
            let side = 1 << whole.level;
            let origin = origin.as_ivec2();
            let corners = [IVec2::ZERO, IVec2::new(side, 0), IVec2::new(0, side)].map(|corner| origin + corner);
            forest.visit(whole.node, corners, &mut |triangle, corners| filling.add(triangle, corners));
            filling.add_margin(origin, side);
        }
        filling
    }

    fn texel(&mut self, at: IVec2) -> &mut u32 {
        &mut self.element_of[(at.y as u32 * self.width + at.x as u32) as usize]
    }

    /// Assigns the texels within an element and on its edges to it.
    fn add(&mut self, triangle: u32, corners: [IVec2; 3]) {
        let number = self.elements.len() as u32;
        self.elements.push(TileElement { triangle, corners: corners.map(|corner| corner.as_uvec2()) });
        let [a, b, c] = corners;
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let turn = (b - a).perp_dot(c - a).signum();
        for y in low.y..=high.y {
            for x in low.x..=high.x {
                let at = IVec2::new(x, y);
                let is_in =
                    [(a, b), (b, c), (c, a)].iter().all(|&(from, to)| turn * (to - from).perp_dot(at - from) >= 0);
                if is_in {
                    *self.texel(at) = number;
                }
            }
        }
    }

    /// Assigns the texels of the margin to the nearest element, and lists those beyond the long side.
    fn add_margin(&mut self, origin: IVec2, side: i32) {
        for y in -1..=side + 1 {
            for x in -1..=side + 1 {
                let inner = IVec2::new(x, y).clamp(IVec2::ZERO, IVec2::splat(side));
                let at = IVec2::new(x, y);
                match inner.x + inner.y - side {
                    ..=0 => *self.texel(origin + at) = *self.texel(origin + inner),
                    1 if inner == at => self.beyond.push((origin + at).as_uvec2()),
                    _ => {}
                }
            }
        }
    }
}
