//! The solved light of a scene and everything that is computed from it without another bake: measurements, patch views,
//! traced views, recordings.

pub mod meter;
pub mod patch_view;
pub mod recording;
pub mod solved;
pub mod traced_view;

pub(super) mod file_names;
