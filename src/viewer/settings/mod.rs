//! What the user sets in the panels and with keys: plain values that the panels edit and everything else reads.

pub mod comparison;
pub mod view;

pub(super) mod light;
pub(super) mod picture_file;
pub(super) mod tool;
