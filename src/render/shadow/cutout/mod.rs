//! Cut-out shadows: shadows of casters with holes, and of casters that blend.
//!
//! Shadow volumes and planar shadows use the outline of a triangle and ignore the holes in its texture. For triangles
//! with holes, each visible point traces the line to the light through a tree of boxes on the device. If the line hits
//! a solid place, the point is marked in the stencil.

mod cutout_shadow;
mod cutouts;

pub use cutout_shadow::CutoutShadowPass;
pub use cutouts::SceneCutouts;
