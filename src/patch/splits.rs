//! Edges that are halved beyond the element size, where light needs finer elements.
//!
//! An edge is identified by the positions of its ends, so that both triangles at the edge, and all other surfaces that
//! meet there, are halved alike.

use glam::Vec3;
use rustc_hash::FxHashSet;

/// Edges to be halved, by the bits of the positions of their ends.
#[derive(Clone, Debug, Default)]
pub struct Splits(FxHashSet<[[u32; 3]; 2]>);

impl Splits {
    /// Adds the edge between two positions. Returns false if it is there already.
    pub fn insert(&mut self, a: Vec3, b: Vec3) -> bool {
        self.0.insert(edge(a, b))
    }

    /// Returns true if the edge between two positions is to be halved.
    #[must_use]
    pub fn contains(&self, a: Vec3, b: Vec3) -> bool {
        !self.0.is_empty() && self.0.contains(&edge(a, b))
    }

    /// Returns true if no edge is to be halved.
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

fn edge(a: Vec3, b: Vec3) -> [[u32; 3]; 2] {
    // Adding zero turns -0 into +0.
    let ends = [a, b].map(|place| (place + Vec3::ZERO).to_array().map(f32::to_bits));
    if ends[0] <= ends[1] { ends } else { [ends[1], ends[0]] }
}
