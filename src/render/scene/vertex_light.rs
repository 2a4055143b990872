//! The light of a scene's vertices on the device. It is rewritten while a bake runs and when a recorded bake is
//! replayed.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use glam::Vec3;

use super::vertex_order::VertexOrder;
use crate::baked::VertexLight;
use crate::gpu::Gpu;

/// Irradiance on the device: three f32 for each `[2 x group + (0 direct, 1 indirect)][vertex]`. The vertices are in the
/// order of the device.
#[derive(Clone)]
pub(super) struct LightBuffer {
    /// The buffer.
    pub irradiance: wgpu::Buffer,
    pub num_groups: usize,
    pub num_vertices: usize,
    num_writes: Arc<AtomicU64>,
}

/// A version of the light of one scene. Each write creates a new version.
#[derive(Clone, Debug, PartialEq)]
pub struct LightVersion {
    irradiance: wgpu::Buffer,
    num_writes: u64,
}

impl LightBuffer {
    /// Creates a buffer of zeros for all groups. It is never empty, because an empty buffer cannot be bound.
    pub fn new(gpu: &Gpu, num_groups: usize, num_vertices: usize) -> Self {
        let irradiance = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("vertex irradiance"),
            size: ((2 * num_groups * num_vertices).max(1) * size_of::<Vec3>()) as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { irradiance, num_groups, num_vertices, num_writes: Arc::default() }
    }

    /// Returns the version of the light.
    pub fn version(&self) -> LightVersion {
        let num_writes = self.num_writes.load(Ordering::Acquire);
        LightVersion { irradiance: self.irradiance.clone(), num_writes }
    }

    /// Writes `light`, group by group and part by part, and calls `written` after each part.
    pub fn write(&self, gpu: &Gpu, order: &VertexOrder, light: &VertexLight, written: impl Fn(&Gpu)) {
        let part_size = (self.num_vertices * size_of::<Vec3>()) as u64;
        let parts = light.groups.iter().take(self.num_groups).flat_map(|group| [&group.direct, &group.indirect]);
        for (part, values) in parts.enumerate() {
            assert_eq!(values.len(), self.num_vertices, "light of another mesh");
            let values = order.sorted(values);
            gpu.queue.write_buffer(&self.irradiance, part as u64 * part_size, bytemuck::cast_slice(&values));
            self.num_writes.fetch_add(1, Ordering::Release);
            written(gpu);
        }
    }
}
