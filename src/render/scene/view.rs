//! What of a scene is in view: its triangles in chunks, those out of view left out.

use std::ops::Range;

use glam::Vec4;

use super::SceneBuffers;
use super::buffers::Batch;
use super::tiled_mesh::TiledMesh;
use crate::base::bounds::{Bounds, Frustum};
use crate::gpu::Gpu;

/// Neighbouring triangles of one batch.
#[derive(Clone, Debug)]
pub(super) struct Chunk {
    pub batch: usize,
    pub indices: Range<u32>,
    pub bounds: Bounds,
}

/// From where a scene is seen.
#[derive(Clone, Copy, Debug)]
pub struct Outlook {
    /// What is in view.
    pub frustum: Frustum,
    /// The eye with w = 1, or the direction towards it with w = 0.
    pub eye: Vec4,
    /// Single-sided surfaces are not seen from behind.
    pub cull_back: bool,
}

impl Outlook {
    /// How far a chunk is away, in any measure; none where it is out of view.
    pub(super) fn distance(&self, chunk: &Chunk) -> Option<f32> {
        let Bounds { low, high } = chunk.bounds;
        let eye = self.eye.truncate();
        self.frustum.meets(&chunk.bounds).then(|| match self.eye.w {
            0.0 => -eye.dot(0.5 * (low + high)),
            _ => eye.distance_squared(eye.clamp(low, high)),
        })
    }
}

impl SceneBuffers {
    /// The part of the scene that a view may see, in the same buffers.
    #[must_use]
    pub fn in_view(&self, gpu: &Gpu, from: &Outlook) -> Self {
        let batches = seen(&self.batches, &self.chunks, &from.frustum);
        let tiled = self.tiled.as_ref().map(|tiled| tiled.in_view(gpu, from));
        self.sharing_buffers(self.indices.clone(), batches, Vec::new(), tiled)
    }

    /// Indices and batches of the coarse mesh where there is one, else of the elements.
    #[must_use]
    pub fn coarsest(&self) -> (&wgpu::Buffer, &[Batch]) {
        match &self.tiled {
            Some(tiled) => (&tiled.indices, &tiled.batches),
            None => (&self.indices, &self.batches),
        }
    }

    /// The vertices that a batch indexes.
    #[must_use]
    pub fn vertices_of(&self, batch: &Batch) -> &wgpu::Buffer {
        let tiled = self.tiled.as_ref().filter(|_| batch.is_tiled);
        tiled.map_or(&self.vertices, |tiled| &tiled.vertices)
    }

    /// Other triangles of the same vertices.
    pub(super) fn sharing_buffers(
        &self,
        indices: wgpu::Buffer,
        batches: Vec<Batch>,
        chunks: Vec<Chunk>,
        tiled: Option<TiledMesh>,
    ) -> Self {
        Self {
            vertices: self.vertices.clone(),
            indices,
            materials: self.materials.clone(),
            batches,
            chunks,
            tiled,
            pre_exposure: self.pre_exposure,
            light: self.light.clone(),
            num_groups: self.num_groups,
            num_vertices: self.num_vertices,
            vertex_order: self.vertex_order.clone(),
        }
    }
}

/// The parts of the batches whose chunks meet the view; chunks one behind the other are one draw.
fn seen(batches: &[Batch], chunks: &[Chunk], frustum: &Frustum) -> Vec<Batch> {
    let mut seen: Vec<Batch> = Vec::new();
    let mut last = None;
    for chunk in chunks.iter().filter(|chunk| frustum.meets(&chunk.bounds)) {
        match seen.last_mut() {
            Some(batch) if last == Some(chunk.batch) && batch.indices.end == chunk.indices.start => {
                batch.indices.end = chunk.indices.end;
            }
            _ => seen.push(Batch { indices: chunk.indices.clone(), ..batches[chunk.batch].clone() }),
        }
        last = Some(chunk.batch);
    }
    seen
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use glam::camera::rh::proj::directx::perspective_infinite_reverse;
    use glam::camera::rh::view::look_at_mat4;

    use super::*;
    use crate::render::scene::order::order;
    use crate::scene::builtin;

    #[test]
    fn all_that_is_in_view_is_drawn_in_its_material_and_not_all_that_there_is() {
        let scene = builtin::gallery();
        let (all, indices) = order(&scene, |_| true);
        let Bounds { low, high } = scene.bounds();
        let eye = low.lerp(high, 0.5);
        for towards in [Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::NEG_Z, Vec3::new(0.4, -0.8, 0.3)] {
            let clip_from_world =
                perspective_infinite_reverse(0.8, 1.6, 0.01) * look_at_mat4(eye, eye + towards, Vec3::Y);
            let batches = seen(&all.batches, &all.chunks, &Frustum::new(&clip_from_world));
            let in_view = |index: u32| {
                let clip = clip_from_world * scene.vertices[index as usize].position.extend(1.0);
                clip.w > 0.0 && clip.x.abs() < clip.w && clip.y.abs() < clip.w
            };
            let mut num_seen = 0;
            for batch in &all.batches {
                for first in batch.indices.clone().step_by(3) {
                    let drawn = batches.iter().filter(|b| b.material == batch.material && b.indices.contains(&first));
                    let (corners, count) = (&indices[first as usize..][..3], drawn.count());
                    assert!(count == 1 || count == 0 && !corners.iter().any(|&c| in_view(c)), "{first}: {count}");
                    num_seen += count;
                }
            }
            assert!(num_seen > 0 && 4 * num_seen < 3 * scene.triangles.len(), "{towards}: {num_seen}");
        }
    }
}
