//! The light samples of one picture on the device, one uniform each in one buffer.

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3, Vec4};
use wgpu::util::DeviceExt;

use super::light_samples::LightSample;
use crate::gpu::Gpu;
use crate::render::Look;
use crate::scene::LightKind;

/// Bytes from one sample to the next: the largest alignment of a dynamic offset that a device may ask for.
const STRIDE: u32 = 256;
/// `1 / (cos inner - cos outer)` is at most one over this, as in `scene::light`.
const NARROWEST_RIM: f32 = 1e-3;

/// `LightSample` of shaders/shared/light_sample.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub struct LightUniform {
    place: Vec4,
    axis: Vec3,
    is_surface: f32,
    intensity: Vec3,
    inverse_square_range: f32,
    cone_scale: f32,
    cone_offset: f32,
    padding: Vec2,
}

impl LightUniform {
    /// A sample, dimmed as `look` wants.
    pub fn new(sample: &LightSample, look: &Look) -> Self {
        const NO_CONE: [f32; 2] = [0.0, 1.0];
        let (axis, cone) = match (sample.surface_normal, sample.light.kind) {
            (Some(normal), _) => (normal, NO_CONE),
            (None, LightKind::Point { .. }) => (Vec3::ZERO, NO_CONE),
            (None, LightKind::Directional { direction }) => (direction, NO_CONE),
            (None, LightKind::Spot { direction, inner_angle, outer_angle, .. }) => {
                let cos_outer = outer_angle.cos();
                let scale = 1.0 / (inner_angle.cos() - cos_outer).max(NARROWEST_RIM);
                (direction, [scale, -cos_outer * scale])
            }
        };
        Self {
            place: sample.place(),
            axis,
            is_surface: f32::from(u8::from(sample.surface_normal.is_some())),
            intensity: sample.light.intensity * look.group_weight(sample.light.group),
            inverse_square_range: sample.light.range.map_or(0.0, |range| 1.0 / (range * range)),
            cone_scale: cone[0],
            cone_offset: cone[1],
            padding: Vec2::ZERO,
        }
    }
}

/// Layout of bind group 1 of every pass that knows a light sample.
pub fn light_sample_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("light sample"),
        entries: &[wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: true,
                min_binding_size: None,
            },
            count: None,
        }],
    })
}

/// The light samples of one picture on the device.
pub struct LightUniforms {
    group: wgpu::BindGroup,
}

impl LightUniforms {
    /// Uploads the samples, dimmed as `look` wants.
    pub fn new(gpu: &Gpu, layout: &wgpu::BindGroupLayout, samples: &[LightSample], look: &Look) -> Self {
        let mut bytes = vec![0; STRIDE as usize * samples.len().max(1)];
        for (slot, sample) in bytes.chunks_exact_mut(STRIDE as usize).zip(samples) {
            slot[..size_of::<LightUniform>()].copy_from_slice(bytemuck::bytes_of(&LightUniform::new(sample, look)));
        }
        let buffer = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("light samples"),
            contents: &bytes,
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let binding = wgpu::BufferBinding {
            buffer: &buffer,
            offset: 0,
            size: wgpu::BufferSize::new(size_of::<LightUniform>() as u64),
        };
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("light samples"),
            layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::Buffer(binding) }],
        });
        Self { group }
    }

    /// Makes sample `index` current.
    pub fn bind(&self, pass: &mut wgpu::RenderPass<'_>, index: usize) {
        pass.set_bind_group(1, &self.group, &[STRIDE * index as u32]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shaders::{DIRECT_LIGHT, struct_layout};
    use std::mem::offset_of;

    #[test]
    fn the_uniform_lies_as_the_shader_reads_it() {
        macro_rules! offsets {
            ($($field:ident),+) => { vec![$(offset_of!(LightUniform, $field)),+, size_of::<LightUniform>()] };
        }
        let written =
            offsets![place, axis, is_surface, intensity, inverse_square_range, cone_scale, cone_offset, padding];
        assert_eq!(written, struct_layout(&DIRECT_LIGHT, "LightSample"));
    }
}
