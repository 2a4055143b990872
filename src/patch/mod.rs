//! Floor 2: the scene divided for light: elements receive, patches shoot, light vertices store the result.
//!
//! A [`PatchMesh`] depends on geometry, reflectance and emission only. `form_factor` draws its elements into item
//! buffers and `radiosity` solves on them. Deliberately absent: any light.
//!
//! * `mesh`: the mesh itself. `cut`: turns a scene into a mesh.
//! * `subdivide`: bisection of triangles into elements; `tree`: the bisection trees; `splits`: edges to bisect beyond
//!   the element size; `propagate`: further edges to bisect so that the mesh stays conforming.
//! * `optics`: reflectance and exitance of elements. `cluster`: elements into patches.

mod cluster;
mod cut;
mod mesh;
mod optics;
mod propagate;
mod splits;
mod subdivide;
mod tree;

pub use mesh::{Element, LightKey, LightVertex, MeshSettings, Patch, PatchMesh, Root, light_key};
pub use splits::Splits;
pub use subdivide::MeshError;
pub use tree::Node;
