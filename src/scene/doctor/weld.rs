//! Welding: corners at exactly equal positions become one vertex, whatever their normals and texture coordinates.

use glam::Vec3;

use crate::scene::Scene;

/// Front triangles of a scene over welded vertices. Backs that a bake wrote are left out.
pub(super) struct Welded {
    /// Positions of the welded vertices `[w]`, metres.
    pub positions: Vec<Vec3>,
    /// Indices of the welded vertices at the corners of each triangle `[i]`.
    pub triangles: Vec<[u32; 3]>,
}

impl Welded {
    /// Welds the vertices of a scene.
    pub fn new(scene: &Scene) -> Self {
        // Adding zero turns -0 into +0, so that equal positions have equal bits.
        let bits = |v: u32| (scene.vertices[v as usize].position + 0.0).to_array().map(f32::to_bits);
        let mut order: Vec<u32> = (0..scene.vertices.len() as u32).collect();
        order.sort_unstable_by_key(|&v| bits(v));
        let mut number = vec![0; order.len()];
        let mut positions = Vec::new();
        for (i, &v) in order.iter().enumerate() {
            if i == 0 || bits(order[i - 1]) != bits(v) {
                positions.push(scene.vertices[v as usize].position);
            }
            number[v as usize] = positions.len() as u32 - 1;
        }
        let triangles = scene
            .fronts()
            .map(|triangle| scene.triangles[triangle.index()].vertices.map(|v| number[v as usize]))
            .collect();
        Self { positions, triangles }
    }

    /// Returns the corner positions of a welded triangle.
    pub fn corners(&self, i: usize) -> [Vec3; 3] {
        self.triangles[i].map(|w| self.positions[w as usize])
    }
}
