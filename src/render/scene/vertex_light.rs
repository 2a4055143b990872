//! The light of a scene's vertices on the device, written again while a bake runs or when a moment is replayed.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use glam::Vec3;

use super::SceneBuffers;
use crate::baked::VertexLight;
use crate::gpu::Gpu;

/// Irradiance on the device: three f32 for `[2 x group + (0 direct, 1 indirect)][vertex]`, vertices in their order there.
#[derive(Clone)]
pub(super) struct LightBuffer {
    irradiance: wgpu::Buffer,
    num_writes: Arc<AtomicU64>,
}

/// A state of the light of one scene: another after each writing.
#[derive(Clone, Debug, PartialEq)]
pub struct LightVersion {
    irradiance: wgpu::Buffer,
    num_writes: u64,
}

impl LightBuffer {
    /// Zeros for all groups; never empty, so that it can be bound.
    pub fn new(gpu: &Gpu, num_groups: usize, num_vertices: usize) -> Self {
        let irradiance = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("vertex irradiance"),
            size: ((2 * num_groups * num_vertices).max(1) * size_of::<Vec3>()) as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { irradiance, num_writes: Arc::default() }
    }
}

impl SceneBuffers {
    /// The irradiance: three f32 for `[2 x group + (0 direct, 1 indirect)][vertex]`, vertices in the order of
    /// [`Self::vertices`].
    #[must_use]
    pub fn irradiance(&self) -> &wgpu::Buffer {
        &self.light.irradiance
    }

    /// The state that the light is in.
    #[must_use]
    pub fn light_version(&self) -> LightVersion {
        let num_writes = self.light.num_writes.load(Ordering::Acquire);
        LightVersion { irradiance: self.light.irradiance.clone(), num_writes }
    }

    /// Replaces the light; the mesh is the same, groups that `light` lacks keep theirs.
    pub fn set_light(&self, gpu: &Gpu, light: &VertexLight) {
        self.write_parts(gpu, light, |_| ());
    }

    /// As [`Self::set_light`], each part on its way before the next, with `rest` between them: a frame of another thread
    /// waits for one part at most.
    pub fn set_light_in_parts(&self, gpu: &Gpu, light: &VertexLight, rest: impl Fn()) {
        self.write_parts(gpu, light, |gpu| {
            gpu.queue.submit([]);
            rest();
        });
    }

    fn write_parts(&self, gpu: &Gpu, light: &VertexLight, written: impl Fn(&Gpu)) {
        let part_size = (self.num_vertices * size_of::<Vec3>()) as u64;
        let parts = light.groups.iter().take(self.num_groups).flat_map(|group| [&group.direct, &group.indirect]);
        for (part, values) in parts.enumerate() {
            assert_eq!(values.len(), self.num_vertices, "light of another mesh");
            let values = self.vertex_order.sorted(values);
            gpu.queue.write_buffer(self.irradiance(), part as u64 * part_size, bytemuck::cast_slice(&values));
            self.light.num_writes.fetch_add(1, Ordering::Release);
            written(gpu);
        }
    }
}
