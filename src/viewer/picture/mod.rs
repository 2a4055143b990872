//! The picture behind the panels: what it shows, when it is drawn anew, and the renderers that draw it.
//!
//! Deliberately absent: passes; every picture is drawn by [`crate::render`].

pub mod canvas;
pub mod content;
pub mod marks;

pub(super) mod comparison;
pub(super) mod marks_cache;
pub(super) mod picture_file;
pub(super) mod scene_renderer;
pub(super) mod texture;
pub(super) mod uploaded_scene;
