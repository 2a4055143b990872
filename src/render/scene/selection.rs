//! Selects parts of a scene on the device that share its buffers: what is in view, and what remains when instances are
//! hidden.

use super::SceneBuffers;
use super::cull_view::CullView;
use super::draw_batch::{Chunk, DrawBatch};
use super::draw_order::{DrawOrder, draw_order, index_buffer};
use super::tiled_mesh::TiledMesh;
use crate::base::bounds::Frustum;
use crate::gpu::Gpu;
use crate::scene::{Scene, Triangle};

impl SceneBuffers {
    /// Returns the part of the scene that may be in view, in the same buffers.
    #[must_use]
    pub fn in_view(&self, gpu: &Gpu, from: &CullView) -> Self {
        let batches = batches_in_view(&self.batches, &self.chunks, &from.frustum);
        let tiled = self.tiled.as_ref().map(|tiled| tiled.in_view(gpu, from));
        self.sharing_buffers(self.indices.clone(), batches, Vec::new(), tiled)
    }

    /// Returns the part of the triangles for which `is_shown` returns true. `scene` must be the scene of these buffers.
    /// Both parts share their light: a write to one changes the other.
    #[must_use]
    pub fn part(&self, gpu: &Gpu, scene: &Scene, is_shown: impl Fn(&Triangle) -> bool) -> Self {
        let (DrawOrder { batches, chunks, .. }, indices) = draw_order(scene, &is_shown);
        let indices = index_buffer(gpu, &self.vertex_order.indices(&indices));
        let tiled = self.tiled.as_ref().map(|tiled| tiled.part(gpu, scene, &self.vertex_order, is_shown));
        self.sharing_buffers(indices, batches, chunks, tiled)
    }

    /// Returns other triangles of the same vertices.
    fn sharing_buffers(
        &self,
        indices: wgpu::Buffer,
        batches: Vec<DrawBatch>,
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
            vertex_order: self.vertex_order.clone(),
        }
    }
}

/// Returns the parts of the batches whose chunks intersect the view. Consecutive chunks of a batch are drawn in one
/// call.
fn batches_in_view(batches: &[DrawBatch], chunks: &[Chunk], frustum: &Frustum) -> Vec<DrawBatch> {
    let mut seen: Vec<DrawBatch> = Vec::new();
    let mut last = None;
    for chunk in chunks.iter().filter(|chunk| frustum.meets(&chunk.bounds)) {
        match seen.last_mut() {
            Some(batch) if last == Some(chunk.batch) && batch.indices.end == chunk.indices.start => {
                batch.indices.end = chunk.indices.end;
            }
            _ => seen.push(DrawBatch { indices: chunk.indices.clone(), ..batches[chunk.batch].clone() }),
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
    use crate::base::bounds::Bounds;
    use crate::scene::builtin;

    #[test]
    fn triangles_in_view_are_drawn_once_and_a_quarter_of_the_scene_is_culled() {
        let scene = builtin::gallery();
        let (all, indices) = draw_order(&scene, |_| true);
        let Bounds { low, high } = scene.bounds();
        let eye = low.lerp(high, 0.5);
        for towards in [Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::NEG_Z, Vec3::new(0.4, -0.8, 0.3)] {
            let clip_from_world =
                perspective_infinite_reverse(0.8, 1.6, 0.01) * look_at_mat4(eye, eye + towards, Vec3::Y);
            let batches = batches_in_view(&all.batches, &all.chunks, &Frustum::new(&clip_from_world));
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
