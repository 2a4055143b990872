//! Sections of the page Picture.

pub mod light;
pub mod shadows;
pub mod view;
