//! Materials of the file: factors and textures, variants, and the original material of a baked file.

mod original;
pub(super) mod reader;
pub(super) mod variant;
