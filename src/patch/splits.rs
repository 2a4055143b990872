//! Edges that are halved beyond the element size, where light asks for it.
//!
//! Edges are named by the places of their ends, so that both triangles at an edge, and those of every other surface that
//! meets there, halve it alike. A triangle is only ever halved at its longest edge; where another one of its edges shall be
//! halved, the longest goes first, and so on through its neighbours.
//!
//! Source: Rivara 1984, "Algorithms for refining triangular grids based on bisection techniques" (propagation).

use glam::Vec3;
use rustc_hash::FxHashSet;

use super::{MeshError, PatchMesh, subdivide};
use crate::scene::Scene;

/// Recuts until every halved edge is one in both its triangles; each recut reaches one triangle farther.
const MAX_RECUTS: usize = 1000;

/// Edges to be halved, by the bits of their ends.
#[derive(Clone, Debug, Default)]
pub struct Splits(FxHashSet<[[u32; 3]; 2]>);

impl Splits {
    /// Asks for the edge between two places to be halved.
    pub fn insert(&mut self, a: Vec3, b: Vec3) -> bool {
        self.0.insert(edge(a, b))
    }

    /// The edge between two places is to be halved.
    #[must_use]
    pub fn contains(&self, a: Vec3, b: Vec3) -> bool {
        !self.0.is_empty() && self.0.contains(&edge(a, b))
    }

    /// Cuts the scene with these edges halved, and as many more as keep the mesh conforming.
    pub(super) fn cut(&mut self, scene: &Scene, element_size: f32) -> Result<PatchMesh, MeshError> {
        for _ in 0..MAX_RECUTS {
            let mesh = subdivide::subdivide(scene, element_size, self)?;
            if self.0.is_empty() || !self.propagate(&mesh) {
                return Ok(mesh);
            }
        }
        subdivide::subdivide(scene, element_size, self)
    }

    /// Adds the longest edge of every element that has a shorter one to be halved; false where there is none.
    fn propagate(&mut self, mesh: &PatchMesh) -> bool {
        let mut has_grown = false;
        for element in mesh.elements.iter().filter(|element| !element.is_back) {
            let corners = mesh.corners(element);
            let is_asked = (0..3).any(|k| self.contains(corners[(k + 1) % 3], corners[(k + 2) % 3]));
            if is_asked {
                let (apex, _) = subdivide::longest_edge(corners);
                has_grown |= self.insert(corners[(apex + 1) % 3], corners[(apex + 2) % 3]);
            }
        }
        has_grown
    }
}

fn edge(a: Vec3, b: Vec3) -> [[u32; 3]; 2] {
    // Adding zero makes -0 and +0 one place.
    let ends = [a, b].map(|place| (place + Vec3::ZERO).to_array().map(f32::to_bits));
    if ends[0] <= ends[1] { ends } else { [ends[1], ends[0]] }
}
