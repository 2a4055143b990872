//! The solved light of a scene and everything that is computed from it without another bake: measurements, patch views,
//! traced views, recordings.

pub(super) mod file_names;
pub(super) mod meter;
pub(super) mod patch_view;
pub(super) mod recording;
pub(super) mod solved;
pub(super) mod traced_view;
