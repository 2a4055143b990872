//! The lights of a scene and how rays sample them.

pub(crate) mod beams;
pub(crate) mod light_bounds;
pub(crate) mod light_tree;
pub(crate) mod lights;
