//! Everything that is drawn over the picture.

pub mod comparison;
pub mod legend;
pub mod markers;
