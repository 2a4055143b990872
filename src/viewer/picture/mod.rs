//! The content of a picture of the scene, the marks over it, and the scene on the device.

pub mod content;

pub(super) mod marks;
pub(super) mod marks_cache;
pub(super) mod texture;
pub(super) mod uploaded_scene;
