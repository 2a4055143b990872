//! Conforming refinement: finds the further edges that must be halved when some edges are halved.
//!
//! A triangle is only ever halved at its longest edge. Where another of its edges is to be halved, the longest edge has
//! to be halved first, and so on through the neighbours, until every halved edge is halved in all triangles that share
//! it.
//!
//! Source: Rivara 1984, "Algorithms for refining triangular grids based on bisection techniques" (propagation).

use super::mesh::PatchMesh;
use super::splits::Splits;
use super::subdivide::{MeshError, longest_edge, subdivide};
use crate::scene::Scene;

/// Largest number of cuts; each one propagates splits by one triangle.
const MAX_CUTS: usize = 1000;

/// Cuts the scene at the edges of `splits` and at those that keep the mesh conforming, which are added to `splits`.
pub(super) fn cut(scene: &Scene, element_size: f32, splits: &mut Splits) -> Result<PatchMesh, MeshError> {
    for _ in 0..MAX_CUTS {
        let mesh = subdivide(scene, element_size, splits)?;
        if splits.is_empty() || !propagate(splits, &mesh) {
            return Ok(mesh);
        }
    }
    subdivide(scene, element_size, splits)
}

/// Adds the longest edge of every element that has a shorter edge to be halved. Returns false if there is none to add.
fn propagate(splits: &mut Splits, mesh: &PatchMesh) -> bool {
    let mut has_grown = false;
    for element in mesh.elements.iter().filter(|element| !element.is_back) {
        let corners = mesh.corners(element);
        let has_split = (0..3).any(|k| splits.contains(corners[(k + 1) % 3], corners[(k + 2) % 3]));
        if has_split {
            let (apex, _) = longest_edge(corners);
            has_grown |= splits.insert(corners[(apex + 1) % 3], corners[(apex + 2) % 3]);
        }
    }
    has_grown
}
