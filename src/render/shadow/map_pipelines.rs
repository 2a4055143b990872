//! How shadow maps are written and read: pipelines of casters, layouts of bindings.

use wgpu::util::DeviceExt;

use super::pipeline::{PipelineRecipe, nearest};
use crate::gpu::Gpu;

/// Of every map.
pub const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Of every overview.
pub const OVERVIEW_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// A small buffer of numbers.
pub fn uniform_buffer(gpu: &Gpu, contents: &[u8]) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::UNIFORM;
    gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some("shadow map"), contents, usage })
}

/// An entry of a layout.
pub fn entry(binding: u32, visibility: wgpu::ShaderStages, ty: wgpu::BindingType) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None }
}

/// A uniform buffer.
pub const UNIFORM: wgpu::BindingType = wgpu::BindingType::Buffer {
    ty: wgpu::BufferBindingType::Uniform,
    has_dynamic_offset: false,
    min_binding_size: None,
};

/// All faces of a map.
pub const DEPTH_ARRAY: wgpu::BindingType = wgpu::BindingType::Texture {
    sample_type: wgpu::TextureSampleType::Depth,
    view_dimension: wgpu::TextureViewDimension::D2Array,
    multisampled: false,
};

/// Overviews of all faces of a map.
pub const OVERVIEW_ARRAY: wgpu::BindingType = wgpu::BindingType::Texture {
    sample_type: wgpu::TextureSampleType::Float { filterable: false },
    view_dimension: wgpu::TextureViewDimension::D2Array,
    multisampled: false,
};

/// How texels are gathered.
pub const GATHERED: wgpu::BindingType = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::NonFiltering);

/// Layout of bind group 1 of the pass that draws a face.
pub fn face_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("shadow map face"),
        entries: &[entry(0, wgpu::ShaderStages::VERTEX, UNIFORM)],
    })
}

/// Layout of bind group 2 of the pass that reads the map.
pub fn read_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let read = wgpu::ShaderStages::FRAGMENT;
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("shadow map"),
        entries: &[
            entry(0, read, UNIFORM),
            entry(1, read, DEPTH_ARRAY),
            entry(2, read, GATHERED),
            entry(3, read, OVERVIEW_ARRAY),
        ],
    })
}

/// A pipeline for casters that are opaque, or that have the `ALPHA_MODE` of shaders/shared/material.wgsl.
pub fn pipeline(
    gpu: &Gpu,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    alpha_mode: Option<f64>,
) -> wgpu::RenderPipeline {
    PipelineRecipe {
        constants: &[("ALPHA_MODE", alpha_mode.unwrap_or(0.0))],
        fragment: alpha_mode.map(|_| ("fragment", [].as_slice())),
        depth_stencil: Some(nearest(DEPTH_FORMAT)),
        ..PipelineRecipe::new("shadow map", layout, module)
    }
    .make(gpu)
}
