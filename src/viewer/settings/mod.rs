//! What the user sets in the panels and with keys: plain values that the panels edit and everything else reads.

pub mod comparison;
pub mod light;
pub mod picture_file;
pub mod tool;
pub mod view;
