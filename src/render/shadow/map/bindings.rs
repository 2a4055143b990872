//! Formats, bindings and pipelines of shadow maps.

use wgpu::util::DeviceExt;

use crate::gpu::Gpu;
use crate::render::shadow::shared::pipeline::{PipelineRecipe, nearest};

/// Format of all shadow maps.
pub const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Format of block planes: depth at texel (0, 0), change of depth per texel to the right and downwards, and 1 if the
/// block has a plane.
pub const BLOCK_PLANES_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// Texels across a block: `BLOCK` of shaders/shadow/map/projection.wgsl.
pub const BLOCK: u32 = 8;

/// Returns the number of blocks across a map.
pub fn num_blocks(resolution: u32) -> u32 {
    resolution.div_ceil(BLOCK)
}

/// Creates a uniform buffer with these contents.
pub fn uniform_buffer(gpu: &Gpu, contents: &[u8]) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::UNIFORM;
    gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some("shadow map"), contents, usage })
}

/// Returns an entry of a bind group layout.
pub fn entry(binding: u32, visibility: wgpu::ShaderStages, ty: wgpu::BindingType) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None }
}

/// Binding of a uniform buffer.
pub const UNIFORM: wgpu::BindingType = wgpu::BindingType::Buffer {
    ty: wgpu::BufferBindingType::Uniform,
    has_dynamic_offset: false,
    min_binding_size: None,
};

/// Binding of all faces of a map.
pub const DEPTH_ARRAY: wgpu::BindingType = wgpu::BindingType::Texture {
    sample_type: wgpu::TextureSampleType::Depth,
    view_dimension: wgpu::TextureViewDimension::D2Array,
    multisampled: false,
};

/// Binding of the block planes of all faces of a map.
pub const BLOCK_PLANES_ARRAY: wgpu::BindingType = wgpu::BindingType::Texture {
    sample_type: wgpu::TextureSampleType::Float { filterable: false },
    view_dimension: wgpu::TextureViewDimension::D2Array,
    multisampled: false,
};

/// Binding of the sampler for `textureGather`.
pub const GATHERED: wgpu::BindingType = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::NonFiltering);

/// Creates the layout of bind group 1 of the pass that draws a face.
pub fn face_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("shadow map face"),
        entries: &[entry(0, wgpu::ShaderStages::VERTEX, UNIFORM)],
    })
}

/// Creates the layout of bind group 2 of a pass that reads one map.
pub fn read_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let read = wgpu::ShaderStages::FRAGMENT;
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("shadow map"),
        entries: &[
            entry(0, read, UNIFORM),
            entry(1, read, DEPTH_ARRAY),
            entry(2, read, GATHERED),
            entry(3, read, BLOCK_PLANES_ARRAY),
        ],
    })
}

/// Creates the pipeline for opaque casters (`None`), or for casters with the given `ALPHA_MODE` of
/// shaders/shared/material.wgsl.
pub fn caster_pipeline(
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
