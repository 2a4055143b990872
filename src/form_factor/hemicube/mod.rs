//! Form factors from item buffers drawn by the GPU: the hemicube method.
//!
//! Nusselt's analogue holds for any surface around a viewpoint: what covers the same directions has the same form
//! factor. The hemicube is half a cube of side 2 around the viewpoint, whose five faces a rasteriser can draw. Each
//! pixel has a
//! *delta form factor*, the share of the view that it covers:
//!
//! - top face, pixel at (x, y, 1): dF = dA / (pi (x^2 + y^2 + 1)^2)
//! - side faces, pixel at height z: dF = z dA / (pi (x^2 + z^2 + 1)^2)
//!
//! The faces are drawn with element ids in place of colours (an item buffer), so the depth test resolves visibility,
//! and F(x, e) is the sum of the delta form factors of the pixels that show e. Many hemicubes share an atlas, and
//! several atlases are in flight, so that drawing, reading back and summing overlap.
//!
//! Source: Cohen, Greenberg 1985, "The Hemi-Cube: a radiosity solution for complex environments"; Weghorst, Hooper,
//! Greenberg 1984 (item buffer).

mod atlas;
mod culling;
mod delta;
mod faces;
mod geometry;
mod hemicubes;
mod index_lists;
mod item_sums;
mod layout;
mod pipeline;
mod resolution;

pub use delta::delta_form_factors;
pub use hemicubes::{Hemicubes, SIZES};
pub use resolution::size_for_patches;
