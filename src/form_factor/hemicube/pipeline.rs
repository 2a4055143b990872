//! The pipeline that draws item buffers, and the layout of its bindings.

use super::geometry::VERTEX_LAYOUT;
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};

/// Item buffer: the element that each pixel of a hemicube shows.
const ITEM_BUFFER: Shader = shader!("item_buffer", "item_buffer.wgsl");

/// One view as a uniform at a dynamic offset, then the triangles, trees, cut-outs and alphas of the scene.
pub(super) fn bindings_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    use wgpu::ShaderStages as Stage;
    let entry = |binding, visibility, ty, has_dynamic_offset| wgpu::BindGroupLayoutEntry {
        binding,
        visibility,
        ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset, min_binding_size: None },
        count: None,
    };
    let storage =
        |binding| entry(binding, Stage::FRAGMENT, wgpu::BufferBindingType::Storage { read_only: true }, false);
    let view = entry(0, Stage::VERTEX, wgpu::BufferBindingType::Uniform, true);
    let entries = [view, storage(1), storage(2), storage(3), storage(4)];
    gpu.device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("item buffer"), entries: &entries })
}

/// Draws the nearest item of each pixel: reversed depth, no culling of backs.
pub(super) fn pipeline(gpu: &Gpu, bindings_layout: &wgpu::BindGroupLayout, has_cutouts: bool) -> wgpu::RenderPipeline {
    let module = ITEM_BUFFER.module(gpu);
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("item buffer"),
        bind_group_layouts: &[Some(bindings_layout)],
        ..Default::default()
    });
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("item buffer"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[Some(VERTEX_LAYOUT)],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: wgpu::TextureFormat::Depth32Float,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &[("HAS_CUTOUTS", f64::from(u8::from(has_cutouts)))],
                ..Default::default()
            },
            targets: &[Some(wgpu::TextureFormat::R32Uint.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
