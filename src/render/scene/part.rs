//! A part of a scene that is on the device: some triangles are left out, everything else is shared.

use super::SceneBuffers;
use super::order::{Order, index_buffer, order};
use crate::gpu::Gpu;
use crate::scene::{Scene, Triangle};

impl SceneBuffers {
    /// Only the triangles of `scene`, which these are the buffers of, that `is_shown` lets pass. Light that is written to the
    /// one is that of the other too.
    #[must_use]
    pub fn part(&self, gpu: &Gpu, scene: &Scene, is_shown: impl Fn(&Triangle) -> bool) -> Self {
        let (Order { batches, chunks, .. }, indices) = order(scene, &is_shown);
        let indices = index_buffer(gpu, &self.vertex_order.indices(&indices));
        let tiled = self.tiled.as_ref().map(|tiled| tiled.part(gpu, scene, &self.vertex_order, is_shown));
        self.sharing_buffers(indices, batches, chunks, tiled)
    }
}
