//! Bind group 0: what one picture asks of every pass.

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec3, Vec4};
use wgpu::util::DeviceExt;

use super::look::MAX_GROUPS;
use super::{Look, Shading, ToneMap, View};
use crate::base::ids::GroupId;
use crate::gpu::{Gpu, SceneBuffers};

/// `Frame` of shaders/shared/frame.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct FrameUniform {
    projection_from_world: Mat4,
    group_weights: [Vec4; MAX_GROUPS],
    ambient: Vec3,
    direct: f32,
    background: Vec3,
    indirect: f32,
    pre_exposure: f32,
    exposure: f32,
    tone_map: u32,
    shading: u32,
    metal_as_diffuse: u32,
    num_groups: u32,
    num_vertices: u32,
    padding: u32,
    eye: Vec4,
    lux_scale: Vec4,
}

impl FrameUniform {
    fn new(scene: &SceneBuffers, view: &View, look: &Look) -> Self {
        let weight = |group: usize| look.group_weight(GroupId::new(group)).extend(0.0);
        Self {
            projection_from_world: view.projection_from_world(),
            group_weights: std::array::from_fn(weight),
            ambient: look.ambient,
            direct: look.direct,
            background: look.background,
            indirect: look.indirect,
            pre_exposure: scene.pre_exposure,
            exposure: look.fixed_exposure().unwrap_or(0.0),
            tone_map: match look.tone_map_in_force() {
                ToneMap::Neutral => 0,
                ToneMap::Linear => 1,
            },
            shading: match look.shading {
                Shading::Lit => 0,
                Shading::IrradianceOnly => 1,
                Shading::Albedo => 2,
                Shading::Normals => 3,
                Shading::FalseColour => 4,
            },
            metal_as_diffuse: u32::from(look.metal_as_diffuse),
            num_groups: scene.num_groups() as u32,
            num_vertices: scene.num_vertices() as u32,
            padding: 0,
            eye: view.eye(),
            lux_scale: look.lux_scale.uniform(),
        }
    }
}

/// Layout of bind group 0.
pub fn frame_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("frame"),
        entries: &[wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT | wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only: true },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        }],
    })
}

/// Bind group 0 of one picture; a fresh one each time, so that several pictures can share a submission.
pub fn frame_bind_group(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    scene: &SceneBuffers,
    view: &View,
    look: &Look,
) -> wgpu::BindGroup {
    let uniform = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("frame"),
        contents: bytemuck::bytes_of(&FrameUniform::new(scene, view, look)),
        usage: wgpu::BufferUsages::STORAGE,
    });
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("frame"),
        layout,
        entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() }],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shaders::{SURFACE, struct_layout};
    use std::mem::offset_of;

    #[test]
    fn the_uniform_lies_as_the_shader_reads_it() {
        macro_rules! offsets {
            ($($field:ident),+) => { vec![$(offset_of!(FrameUniform, $field)),+, size_of::<FrameUniform>()] };
        }
        let written = offsets![
            projection_from_world,
            group_weights,
            ambient,
            direct,
            background,
            indirect,
            pre_exposure,
            exposure,
            tone_map,
            shading,
            metal_as_diffuse,
            num_groups,
            num_vertices,
            padding,
            eye,
            lux_scale
        ];
        assert_eq!(written, struct_layout(&SURFACE, "Frame"));
    }
}
