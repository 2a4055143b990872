//! Order of vertices on the device: the order of their first use, so that neighbours lie side by side in memory.
//!
//! Triangles are drawn in an order that keeps neighbours together (`draw_order`), but a file or a bake may store their
//! vertices in any order. On a software driver a vertex that is not in a cache takes longer to fetch than to transform.

use std::sync::Arc;

/// Order of vertices on the device.
#[derive(Clone)]
pub(super) struct VertexOrder {
    /// Index on the device of each vertex `[v]` of the scene.
    places: Arc<[u32]>,
}

impl VertexOrder {
    /// Creates the order in which `indices` first use each of `num_vertices` vertices. Unused vertices follow.
    pub fn new(indices: &[u32], num_vertices: usize) -> Self {
        const UNUSED: u32 = u32::MAX;
        let mut places = vec![UNUSED; num_vertices];
        let mut next = 0;
        for vertex in indices.iter().copied().chain(0..num_vertices as u32) {
            let place = &mut places[vertex as usize];
            if *place == UNUSED {
                *place = next;
                next += 1;
            }
        }
        Self { places: places.into() }
    }

    /// Returns the index of a vertex on the device.
    pub fn place(&self, vertex: u32) -> u32 {
        self.places[vertex as usize]
    }

    /// Converts indices to indices on the device.
    pub fn indices(&self, indices: &[u32]) -> Vec<u32> {
        indices.iter().map(|&vertex| self.place(vertex)).collect()
    }

    /// Returns values of the vertices `[v]` of the scene, sorted in the order of the device.
    pub fn sorted<T: Copy + Default>(&self, values: &[T]) -> Vec<T> {
        let mut sorted = vec![T::default(); values.len()];
        for (&place, &value) in self.places.iter().zip(values) {
            sorted[place as usize] = value;
        }
        sorted
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertices_are_in_the_order_of_their_first_use() {
        let indices = [4, 2, 5, 5, 2, 0];
        let order = VertexOrder::new(&indices, 6);
        assert_eq!(order.indices(&indices), [0, 1, 2, 2, 1, 3]);
        assert_eq!(order.sorted(&[10, 11, 12, 13, 14, 15]), [14, 12, 15, 10, 11, 13]);
    }
}
