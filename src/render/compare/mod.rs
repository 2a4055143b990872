//! Difference of two pictures: as three numbers, and for each pixel as an eye sees it.

mod difference;
pub mod flip;

pub use difference::{Difference, Raster, compare, is_perceptible, visible_difference};
pub use flip::magma;
