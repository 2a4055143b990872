//! What of a scene is in view: its triangles in chunks, those out of view left out.

use std::ops::Range;

use super::SceneBuffers;
use super::scene_buffers::Batch;
use crate::base::bounds::{Bounds, Frustum};

/// Neighbouring triangles of one batch.
#[derive(Clone, Debug)]
pub(super) struct Chunk {
    pub batch: usize,
    pub indices: Range<u32>,
    pub bounds: Bounds,
}

impl SceneBuffers {
    /// The part of the scene that a view may see, in the same buffers.
    #[must_use]
    pub fn in_view(&self, frustum: &Frustum) -> Self {
        let mut batches: Vec<Batch> = Vec::new();
        let mut last = None;
        for chunk in self.chunks.iter().filter(|chunk| frustum.meets(&chunk.bounds)) {
            match batches.last_mut() {
                // Chunks one behind the other are one draw.
                Some(batch) if last == Some(chunk.batch) && batch.indices.end == chunk.indices.start => {
                    batch.indices.end = chunk.indices.end;
                }
                _ => batches.push(Batch { indices: chunk.indices.clone(), ..self.batches[chunk.batch].clone() }),
            }
            last = Some(chunk.batch);
        }
        self.sharing_buffers(self.indices.clone(), batches, Vec::new())
    }

    /// Other triangles of the same vertices.
    pub(super) fn sharing_buffers(&self, indices: wgpu::Buffer, batches: Vec<Batch>, chunks: Vec<Chunk>) -> Self {
        Self {
            vertices: self.vertices.clone(),
            indices,
            light: self.light.clone(),
            materials: self.materials.clone(),
            batches,
            chunks,
            pre_exposure: self.pre_exposure,
            irradiance: self.irradiance.clone(),
            num_groups: self.num_groups,
            num_vertices: self.num_vertices,
        }
    }
}
