//! Floor 2.5: a scene with its light. It is the result of a bake and the input of every picture.
//!
//! The triangles of a [`BakedScene`] are the *elements*; the back of a double-sided surface is a separate triangle.
//! Everything that works on a [`Scene`](crate::scene::Scene) (rays, shadows, `info`) therefore works on a bake.
//!
//! * `baked_scene`: the elements with their light. `bisection_trees`: how they come from input triangles. `pairing`:
//!   fronts and backs of files that do not say which belong together.
//! * `light_texture`: light as a texture over the scene that was baked.
//! * `gltf/`: both as files. `coarse/`: a mesh of fewer triangles for drawing. `exposure`: brightness of pictures.

mod baked_scene;
mod bisection_trees;
pub(crate) mod coarse;
mod error;
pub mod exposure;
pub mod gltf;
pub mod light_texture;
mod pairing;

pub use baked_scene::{BakedScene, GroupLight, VertexLight};
pub use bisection_trees::BisectionTrees;
pub use error::BakedError;
pub use light_texture::{Lightmap, Texels};
