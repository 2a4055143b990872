//! Settings that the user changes in the panels and with keys: plain values that the panels edit and other parts read.

pub mod comparison;
pub mod view;

pub(super) mod light;
pub(super) mod picture_file;
pub(super) mod tool;
