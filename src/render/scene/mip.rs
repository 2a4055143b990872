//! Mip maps, computed on the CPU in linear light. A mean of sRGB-encoded bytes would be too dark.

use glam::Vec4;
use rayon::prelude::*;

use crate::base::colour::{srgb_byte_table, srgb_from_linear};

/// Meaning of the bytes of an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Encoding {
    /// Colour, sRGB encoded; alpha is linear.
    Srgb,
    /// Data, linear.
    Linear,
}

/// One level of a mip chain: RGBA bytes, row by row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Level {
    /// Texels across.
    pub width: u32,
    /// Texels down.
    pub height: u32,
    /// Bytes in the encoding of the image.
    pub rgba: Vec<u8>,
}

/// Returns all levels of an image down to one texel, beginning with the first that is at most `max_size` wide and high.
#[must_use]
pub fn mip_chain(width: u32, height: u32, rgba: &[u8], encoding: Encoding, max_size: u32) -> Vec<Level> {
    let mut linear = Linear::decode(width, height, rgba, encoding);
    let mut levels = Vec::new();
    if width.max(height) <= max_size {
        levels.push(Level { width, height, rgba: rgba.to_vec() });
    }
    while linear.width.max(linear.height) > 1 {
        linear = linear.halved();
        if linear.width.max(linear.height) <= max_size {
            levels.push(linear.encode(encoding));
        }
    }
    levels
}

/// An image in linear light.
struct Linear {
    width: u32,
    height: u32,
    texels: Vec<Vec4>,
}

impl Linear {
    fn decode(width: u32, height: u32, rgba: &[u8], encoding: Encoding) -> Self {
        let table = srgb_byte_table();
        let colour = |byte: u8| match encoding {
            Encoding::Srgb => table[usize::from(byte)],
            Encoding::Linear => f32::from(byte) / 255.0,
        };
        let (texels, _) = rgba.as_chunks::<4>();
        let texels = texels
            .par_iter()
            .map(|&[r, g, b, a]| Vec4::new(colour(r), colour(g), colour(b), f32::from(a) / 255.0))
            .collect();
        Self { width, height, texels }
    }

    fn encode(&self, encoding: Encoding) -> Level {
        let byte = |value: f32| (value * 255.0).round() as u8;
        let colour = |value: f32| match encoding {
            Encoding::Srgb => byte(srgb_from_linear(value)),
            Encoding::Linear => byte(value),
        };
        let rgba = self.texels.par_iter().flat_map_iter(|t| [colour(t.x), colour(t.y), colour(t.z), byte(t.w)]);
        Level { width: self.width, height: self.height, rgba: rgba.collect() }
    }

    /// Returns the image at half the size, rounded down. Each new texel is the exact mean over the area that it covers.
    /// If a side is odd, this area contains fractions of old texels.
    fn halved(&self) -> Self {
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let columns: Vec<_> = (0..width).map(|x| footprint(x, width, self.width)).collect();
        let texels = (0..height)
            .into_par_iter()
            .flat_map_iter(|y| {
                let rows = footprint(y, height, self.height);
                columns.iter().map(move |columns| self.average(columns, &rows))
            })
            .collect();
        Self { width, height, texels }
    }

    fn average(&self, columns: &Footprint, rows: &Footprint) -> Vec4 {
        let mut sum = Vec4::ZERO;
        for (row, row_weight) in rows.iter() {
            for (column, column_weight) in columns.iter() {
                sum += row_weight * column_weight * self.texels[row * self.width as usize + column];
            }
        }
        sum
    }
}

/// The texels under one texel of the next level along one axis, at most three, and their weights.
struct Footprint {
    first: usize,
    weights: [f32; 3],
}

impl Footprint {
    fn iter(&self) -> impl Iterator<Item = (usize, f32)> {
        let first = self.first;
        self.weights.into_iter().enumerate().filter(|&(_, weight)| weight > 0.0).map(move |(i, w)| (first + i, w))
    }
}

fn footprint(index: u32, size: u32, source_size: u32) -> Footprint {
    let ratio = source_size as f32 / size as f32;
    let (low, high) = (index as f32 * ratio, (index + 1) as f32 * ratio);
    let first = low.floor();
    let weights = std::array::from_fn(|i| {
        let (left, right) = (first + i as f32, first + i as f32 + 1.0);
        // A weight below a thousandth is a rounding error, and its texel may lie outside the image.
        let share = (right.min(high) - left.max(low)) / ratio;
        if share > 1e-3 { share } else { 0.0 }
    });
    Footprint { first: first as usize, weights }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(values: &[u8]) -> Vec<u8> {
        values.iter().flat_map(|&v| [v, v, v, 255]).collect()
    }

    #[test]
    fn colours_are_averaged_in_linear_light_and_data_as_stored() {
        let board = grey(&[0, 255, 255, 0]);
        let colour = mip_chain(2, 2, &board, Encoding::Srgb, 64);
        let data = mip_chain(2, 2, &board, Encoding::Linear, 64);
        assert_eq!(colour[1].rgba, [188, 188, 188, 255]);
        assert_eq!(data[1].rgba, [128, 128, 128, 255]);
    }

    #[test]
    fn odd_sizes_weight_every_texel_equally() {
        let chain = mip_chain(5, 3, &grey(&[[0, 0, 0, 0, 255]; 3].concat()), Encoding::Linear, 64);
        let sizes: Vec<_> = chain.iter().map(|level| (level.width, level.height)).collect();
        assert_eq!(sizes, [(5, 3), (2, 1), (1, 1)]);
        assert_eq!(chain[2].rgba[0], 51, "a fifth of the columns is white");
    }

    #[test]
    fn images_that_are_too_large_begin_with_a_smaller_level() {
        let chain = mip_chain(8, 2, &grey(&[7; 16]), Encoding::Linear, 4);
        assert_eq!((chain[0].width, chain[0].height), (4, 1));
        assert_eq!(chain.len(), 3);
    }
}
