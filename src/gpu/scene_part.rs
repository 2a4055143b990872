//! A part of a scene that is on the device: some triangles are left out, everything else is shared.

use wgpu::util::DeviceExt;

use super::scene_buffers::batches;
use super::{Gpu, SceneBuffers};
use crate::scene::{Scene, Triangle};

impl SceneBuffers {
    /// Only the triangles of `scene`, which these are the buffers of, that `is_shown` lets pass. Light that is written to the
    /// one is that of the other too.
    #[must_use]
    pub fn part(&self, gpu: &Gpu, scene: &Scene, is_shown: impl Fn(&Triangle) -> bool) -> Self {
        let (batches, indices) = batches(scene, is_shown);
        Self {
            vertices: self.vertices.clone(),
            indices: gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("scene indices"),
                contents: bytemuck::cast_slice(&indices),
                usage: wgpu::BufferUsages::INDEX,
            }),
            light: self.light.clone(),
            materials: self.materials.clone(),
            batches,
            pre_exposure: self.pre_exposure,
            irradiance: self.irradiance.clone(),
            num_groups: self.num_groups,
            num_vertices: self.num_vertices,
        }
    }
}
