//! Sections of the page Picture.

pub mod light;
pub mod shadows;
mod technique;
pub mod view;
