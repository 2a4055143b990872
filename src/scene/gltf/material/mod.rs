//! Materials of the file: their factors and textures, variants, and what a bake changed.

mod original;
pub(super) mod reader;
pub(super) mod variant;
