//! Uploads the light samples of one picture: one uniform each, in one buffer.

use bytemuck::{Pod, Zeroable};
use glam::{Vec3, Vec4};
use wgpu::util::DeviceExt;

use super::sample::LightSample;
use super::space::axes;
use crate::base::bounds::Bounds;
use crate::gpu::Gpu;
use crate::render::shadow::shared::frame_context::FrameContext;
use crate::scene::LightKind;

/// Bytes from one sample to the next: the largest alignment that a device may require of a dynamic offset.
const STRIDE: u32 = 256;
/// Smallest `cos inner - cos outer` of a spot's cone, as in `scene::light`.
const NARROWEST_RIM: f32 = 1e-3;
/// Distance from the middle of a scene beyond which a light is `IS_FAR`, in diagonals of the scene.
const FAR: f32 = 4.0;

// Bits of `LightUniform::kind`, as in shaders/shadow/light/light_sample.wgsl and shaders/shadow/map/pcf.wgsl.
const IS_PARALLEL: u32 = 1;
const IS_SURFACE: u32 = 2;
const HAS_CONE: u32 = 4;
const HAS_RANGE: u32 = 8;
const IS_FAR: u32 = 16;
/// Set if the shadow map of the light has six faces.
pub const HAS_CUBE: u32 = 32;

/// `LightSample` of shaders/shadow/light/light_sample.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub struct LightUniform {
    position: Vec4,
    right: Vec3,
    kind: u32,
    up: Vec3,
    inverse_square_range: f32,
    back: Vec3,
    cone_scale: f32,
    intensity: Vec3,
    cone_offset: f32,
    to_origin: Vec3,
    padding: f32,
}

impl LightUniform {
    /// Converts a sample for a picture: dims it with its light group and scales it by pre-exposure.
    pub fn new(sample: &LightSample, frame: FrameContext<'_>) -> Self {
        let (cone_scale, cone_offset) = match sample.light.kind {
            LightKind::Spot { inner_angle, outer_angle, .. } => {
                let cos_outer = outer_angle.cos();
                let scale = 1.0 / (inner_angle.cos() - cos_outer).max(NARROWEST_RIM);
                (scale, -cos_outer * scale)
            }
            LightKind::Point { .. } | LightKind::Directional { .. } => (0.0, 1.0),
        };
        let axes = axes(sample);
        let position = sample.position();
        Self {
            position,
            right: axes.x_axis,
            kind: kind(sample, frame.shadows.bounds()),
            up: axes.y_axis,
            inverse_square_range: sample.light.range.map_or(0.0, |range| 1.0 / (range * range)),
            back: axes.z_axis,
            cone_scale,
            intensity: sample.light.intensity
                * frame.render_settings.group_weight(sample.light.group)
                * frame.scene.pre_exposure,
            cone_offset,
            to_origin: -axes.transpose() * position.truncate(),
            padding: 0.0,
        }
    }

    /// Returns the bits that describe the light, such as `IS_PARALLEL`.
    pub fn kind(&self) -> u32 {
        self.kind
    }
}

fn kind(sample: &LightSample, bounds: Bounds) -> u32 {
    let has = |bit: u32, is_on: bool| if is_on { bit } else { 0 };
    let position = sample.position();
    let is_far = position.truncate().distance(bounds.centre()) > FAR * bounds.diagonal();
    has(IS_PARALLEL, matches!(sample.light.kind, LightKind::Directional { .. }))
        | has(IS_SURFACE, sample.surface_normal.is_some())
        | has(HAS_CONE, matches!(sample.light.kind, LightKind::Spot { .. }))
        | has(HAS_RANGE, sample.light.range.is_some())
        | has(IS_FAR, position.w > 0.0 && is_far)
}

/// Creates the layout of bind group 1 of every pass for one light sample.
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
    /// Uploads the samples for a picture.
    pub fn new(gpu: &Gpu, layout: &wgpu::BindGroupLayout, samples: &[LightSample], frame: FrameContext<'_>) -> Self {
        let mut bytes = vec![0; STRIDE as usize * samples.len().max(1)];
        for (slot, sample) in bytes.chunks_exact_mut(STRIDE as usize).zip(samples) {
            slot[..size_of::<LightUniform>()].copy_from_slice(bytemuck::bytes_of(&LightUniform::new(sample, frame)));
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

    /// Binds sample `index` as bind group 1.
    pub fn bind(&self, pass: &mut wgpu::RenderPass<'_>, index: usize) {
        pass.set_bind_group(1, &self.group, &[STRIDE * index as u32]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shader::{constant, struct_layout};
    use crate::render::shadow::light::direct_light::DIRECT_LIGHT;
    use crate::render::shadow::map::pcf::DIRECT_LIGHT_PCF;
    use std::mem::offset_of;

    #[test]
    fn the_uniform_has_the_layout_of_the_shader() {
        macro_rules! offsets {
            ($($field:ident),+) => { vec![$(offset_of!(LightUniform, $field)),+, size_of::<LightUniform>()] };
        }
        let written = offsets![
            position,
            right,
            kind,
            up,
            inverse_square_range,
            back,
            cone_scale,
            intensity,
            cone_offset,
            to_origin,
            padding
        ];
        assert_eq!(written, struct_layout(&DIRECT_LIGHT, "LightSample"));
    }

    #[test]
    fn kinds_have_the_bits_of_the_shader() {
        macro_rules! same {
            ($($name:ident),+) => { $(assert_eq!($name, constant(&DIRECT_LIGHT_PCF, stringify!($name))));+ };
        }
        same!(IS_PARALLEL, IS_SURFACE, HAS_CONE, HAS_RANGE, IS_FAR, HAS_CUBE);
    }
}
