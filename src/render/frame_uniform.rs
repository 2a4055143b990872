//! Bind group 0: camera, exposure and weights of one picture, for every pass.

use std::f32::consts::PI;

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec3, Vec4};
use wgpu::util::DeviceExt;

use super::settings::MAX_GROUPS;
use super::{RenderSettings, View};
use crate::base::ids::GroupId;
use crate::gpu::Gpu;
use crate::render::scene::SceneBuffers;

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
    num_vertices: u32,
    live: f32,
    eye: Vec4,
    lux_scale: Vec4,
}

impl FrameUniform {
    fn new(scene: &SceneBuffers, view: &View, settings: &RenderSettings) -> Self {
        let weight = |group: usize| settings.group_weight(GroupId::new(group)).extend(0.0);
        // The light of all batches so far is summed. The picture shows their mean.
        let num_batches =
            1 + settings.shadows.as_ref().and_then(|shadows| shadows.batch).map_or(0, |batch| batch.number);
        let live = settings.direct / (PI * num_batches as f32);
        Self {
            projection_from_world: view.projection_from_world(),
            group_weights: std::array::from_fn(weight),
            ambient: settings.ambient,
            direct: settings.direct,
            background: settings.background,
            indirect: settings.indirect,
            pre_exposure: scene.pre_exposure,
            exposure: settings.fixed_exposure().unwrap_or(0.0),
            num_vertices: scene.num_vertices() as u32,
            live,
            eye: view.eye(),
            lux_scale: settings.lux_scale.uniform(),
        }
    }
}

/// `Choices` of shaders/shared/frame.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct ChoicesStorage {
    tone_map: u32,
    num_groups: u32,
}

impl ChoicesStorage {
    fn new(scene: &SceneBuffers, settings: &RenderSettings) -> Self {
        Self { tone_map: settings.tone_map_in_force().number(), num_groups: scene.num_groups() as u32 }
    }
}

/// Creates the layout of bind group 0.
pub fn frame_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT | wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
        count: None,
    };
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("frame"),
        entries: &[
            entry(0, wgpu::BufferBindingType::Uniform),
            entry(1, wgpu::BufferBindingType::Storage { read_only: true }),
        ],
    })
}

/// Creates bind group 0 of one picture. It has buffers of its own, so that several pictures can share a submission.
pub fn frame_bind_group(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    scene: &SceneBuffers,
    view: &View,
    settings: &RenderSettings,
) -> wgpu::BindGroup {
    let buffer = |contents: &[u8], usage| {
        gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some("frame"), contents, usage })
    };
    let uniform = buffer(bytemuck::bytes_of(&FrameUniform::new(scene, view, settings)), wgpu::BufferUsages::UNIFORM);
    let choices = buffer(bytemuck::bytes_of(&ChoicesStorage::new(scene, settings)), wgpu::BufferUsages::STORAGE);
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("frame"),
        layout,
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: choices.as_entire_binding() },
        ],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shader::struct_layout;
    use crate::render::surface::direct_source::SURFACE;
    use std::mem::offset_of;

    #[test]
    fn the_layout_of_the_uniform_is_that_of_the_shader() {
        macro_rules! offsets {
            ($($field:ident),+) => { vec![$(offset_of!(FrameUniform, $field)),+, size_of::<FrameUniform>()] };
        }
        // The shader has no name for the gap before `eye`.
        let written = offsets![
            projection_from_world,
            group_weights,
            ambient,
            direct,
            background,
            indirect,
            pre_exposure,
            exposure,
            num_vertices,
            live,
            eye,
            lux_scale
        ];
        assert_eq!(written, struct_layout(&SURFACE, "Frame"));
    }
}
