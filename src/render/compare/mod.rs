//! How far two pictures differ: in three numbers, and pixel by pixel as an eye sees it.

mod difference;
pub mod flip;

pub use difference::{Difference, Raster, compare, is_perceptible, visible_difference};
pub use flip::magma;
