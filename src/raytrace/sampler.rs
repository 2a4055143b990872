//! Random numbers of paths: points of the unit square that are spread evenly over all paths of a pixel or point.
//!
//! Each decision of a path takes a pair of Sobol dimensions. Owen scrambling keeps their even spread (every 2^n points
//! fill the elementary intervals of the square) and makes sequences with different seeds independent; shuffled indices
//! make the decisions of one path independent.
//!
//! Source: Burley 2020, "Practical Hash-based Owen Scrambling".

use glam::Vec2;

use crate::base::sampling::{hash, unit_float};

/// The random numbers of one path, in the order of its decisions.
#[derive(Clone, Debug)]
pub(crate) struct Sampler {
    /// Seed of the pixel or point.
    seed: u32,
    /// Number of the path at this pixel or point.
    index: u32,
    num_decisions: u32,
}

impl Sampler {
    /// Returns the numbers of the `index`-th path at the pixel or point with this seed.
    pub(crate) fn new(seed: u32, index: u32) -> Self {
        Self { seed: hash(seed), index, num_decisions: 0 }
    }

    /// The next point of the unit square.
    pub(crate) fn square(&mut self) -> Vec2 {
        let seed = self.next_seed();
        let index = owen_scrambled(self.index, seed);
        let x = owen_scrambled(index.reverse_bits(), hash(seed ^ 0x5851_f42d));
        let y = owen_scrambled(sobol_second(index), hash(seed ^ 0x1405_7b7e));
        Vec2::new(unit_float(x), unit_float(y))
    }

    /// The next number in [0, 1).
    pub(crate) fn number(&mut self) -> f32 {
        let seed = self.next_seed();
        let index = owen_scrambled(self.index, seed);
        unit_float(owen_scrambled(index.reverse_bits(), hash(seed ^ 0x5851_f42d)))
    }

    /// The next 32 bits, independent between paths.
    pub(crate) fn bits(&mut self) -> u32 {
        hash(self.next_seed() ^ hash(self.index))
    }

    fn next_seed(&mut self) -> u32 {
        self.num_decisions += 1;
        hash(self.seed.wrapping_add(self.num_decisions.wrapping_mul(0x9e37_79b9)))
    }
}

/// Flips each bit by a hash of the bits above it.
fn owen_scrambled(bits: u32, seed: u32) -> u32 {
    // The hash of Laine and Karras 2011 scrambles from the lowest bit up.
    let mut x = bits.reverse_bits();
    x = x.wrapping_add(seed);
    x ^= x.wrapping_mul(0x6c50_b47c);
    x ^= x.wrapping_mul(0xb82f_1e52);
    x ^= x.wrapping_mul(0xc7af_e638);
    x ^= x.wrapping_mul(0x8d22_f6e6);
    x.reverse_bits()
}

/// Second dimension of the Sobol sequence: Pascal's triangle modulo 2 times the bits of `index`, level by level.
fn sobol_second(index: u32) -> u32 {
    let mut x = index.reverse_bits();
    for (shift, mask) in [(16, 0xffff_0000), (8, 0xff00_ff00), (4, 0xf0f0_f0f0), (2, 0xcccc_cccc), (1, 0xaaaa_aaaa)] {
        x ^= (x << shift) & mask;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_second_dimension_has_the_direction_numbers_of_sobol() {
        // Direction numbers 1, 3, 5, 15 (Joe and Kuo 2008), left-aligned.
        let expected = [0x8000_0000, 0xc000_0000, 0xa000_0000, 0xf000_0000];
        assert_eq!(std::array::from_fn(|bit| sobol_second(1 << bit)), expected);
    }

    #[test]
    fn sixteen_points_fill_each_sixteenth_of_the_square_once() {
        for (columns, rows) in [(16, 1), (8, 2), (4, 4), (2, 8), (1, 16)] {
            let mut counts = [0; 16];
            for index in 32..48 {
                let mut sampler = Sampler::new(7, index);
                sampler.square();
                let point = sampler.square();
                counts[(point.x * columns as f32) as usize + columns * (point.y * rows as f32) as usize] += 1;
            }
            assert_eq!(counts, [1; 16], "{columns} x {rows}");
        }
    }

    #[test]
    fn two_decisions_of_a_path_are_uncorrelated() {
        let product = |index| {
            let mut sampler = Sampler::new(3, index);
            (sampler.number() - 0.5) * (sampler.number() - 0.5)
        };
        let covariance = (0..4096).map(product).sum::<f32>() / 4096.0;
        assert!(covariance.abs() < 2e-3, "{covariance}");
    }
}
