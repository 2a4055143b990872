//! A coarse mesh of a bake, whose triangles have the light of their elements in tiles of a texture.
//!
//! A bake has many times as many triangles as its scene, because light changes faster than surfaces do. A picture does
//! not need them: interpolation between texels of a tile shows the same as interpolation between the vertices of
//! elements.
//!
//! It is designed for software rendering (`viewer::software`), which it makes faster. It is also used on hardware,
//! where the gain has not been measured.
//!
//! * `bisection`: the bisection trees of the elements. `coarsen`: which of their nodes are drawn as one triangle.
//!   `tiles`: the light of these triangles in a texture. `coarse_mesh`: the mesh that is made of all of these.

mod bisection;
mod coarse_mesh;
mod coarsen;
pub(crate) mod tiles;

#[cfg(test)]
mod tests;

pub(crate) use coarse_mesh::{CoarseMesh, Tile};
