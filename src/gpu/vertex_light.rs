//! The light of a scene's vertices on the device, written again while a bake runs or when a moment is replayed.

use glam::Vec3;

use super::{Gpu, SceneBuffers};
use crate::baked::VertexLight;

/// Layout of the light's bind group: three f32 for `[2 x group + (0 direct, 1 indirect)][vertex]`.
#[must_use]
pub fn light_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("vertex light"),
        entries: &[wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::VERTEX,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only: true },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        }],
    })
}

impl SceneBuffers {
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
            gpu.queue.write_buffer(&self.irradiance, part as u64 * part_size, bytemuck::cast_slice(values));
            written(gpu);
        }
    }
}

/// A buffer of zeros for all groups; never empty, so that it can be bound.
pub(super) fn irradiance_buffer(gpu: &Gpu, num_groups: usize, num_vertices: usize) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("vertex irradiance"),
        size: ((2 * num_groups * num_vertices).max(1) * size_of::<Vec3>()) as u64,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

pub(super) fn light_bind_group(gpu: &Gpu, irradiance: &wgpu::Buffer) -> wgpu::BindGroup {
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("vertex light"),
        layout: &light_layout(gpu),
        entries: &[wgpu::BindGroupEntry { binding: 0, resource: irradiance.as_entire_binding() }],
    })
}
