//! Drawing of the picture: the canvas with the last picture, its renderers, heat maps of compared shadows, and pictures
//! for files.
//!
//! Deliberately absent: passes; every picture is drawn by [`crate::render`].

pub mod canvas;

pub(super) mod comparison;
pub(super) mod picture_file;
pub(super) mod scene_renderer;
