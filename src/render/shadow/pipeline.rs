//! Pipelines of the shadow passes: what they have in common is said here once.

use glam::Vec4;

use super::light_targets::depth_stencil_format;
use crate::gpu::Gpu;
use crate::render::scene::gpu_vertex::GpuVertex;

/// Homogeneous corners.
pub const CORNER: wgpu::VertexBufferLayout<'_> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Vec4>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x4],
};

/// What a pipeline of triangles is made of. Its vertex stage is called `vertex`; without more it draws the vertices of
/// the scene with no fragment stage into nothing, one sample a pixel.
pub struct PipelineRecipe<'a> {
    /// What it is called.
    pub label: &'a str,
    /// Bind groups.
    pub layout: &'a wgpu::PipelineLayout,
    /// Shader.
    pub module: &'a wgpu::ShaderModule,
    /// Values of its `override` constants.
    pub constants: &'a [(&'a str, f64)],
    /// What a vertex is; none where the shader makes its own.
    pub vertex: Option<wgpu::VertexBufferLayout<'a>>,
    /// Entry point of the fragment stage, and what it writes to.
    pub fragment: Option<(&'a str, &'a [Option<wgpu::ColorTargetState>])>,
    /// Which faces are drawn, and which are fronts.
    pub primitive: wgpu::PrimitiveState,
    /// Tests of depth and stencil.
    pub depth_stencil: Option<wgpu::DepthStencilState>,
    /// Samples a pixel.
    pub samples: u32,
}

impl<'a> PipelineRecipe<'a> {
    /// The least that a pipeline needs.
    pub fn new(label: &'a str, layout: &'a wgpu::PipelineLayout, module: &'a wgpu::ShaderModule) -> Self {
        Self {
            label,
            layout,
            module,
            constants: &[],
            vertex: Some(GpuVertex::LAYOUT),
            fragment: None,
            primitive: Default::default(),
            depth_stencil: None,
            samples: 1,
        }
    }

    /// The pipeline.
    pub fn make(self, gpu: &Gpu) -> wgpu::RenderPipeline {
        let options = wgpu::PipelineCompilationOptions { constants: self.constants, ..Default::default() };
        gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(self.label),
            layout: Some(self.layout),
            vertex: wgpu::VertexState {
                module: self.module,
                entry_point: Some("vertex"),
                compilation_options: options.clone(),
                buffers: &[self.vertex],
            },
            primitive: self.primitive,
            depth_stencil: self.depth_stencil,
            multisample: wgpu::MultisampleState { count: self.samples, ..Default::default() },
            fragment: self.fragment.map(|(entry_point, targets)| wgpu::FragmentState {
                module: self.module,
                entry_point: Some(entry_point),
                compilation_options: options,
                targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

/// Which faces are left out.
pub fn culling(cull_mode: Option<wgpu::Face>) -> wgpu::PrimitiveState {
    wgpu::PrimitiveState { cull_mode, ..Default::default() }
}

/// Tests against the depth of the visible surfaces, which stays as it is.
pub fn against_depth(
    gpu: &Gpu,
    compare: wgpu::CompareFunction,
    stencil: wgpu::StencilState,
    bias: wgpu::DepthBiasState,
) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: depth_stencil_format(gpu),
        depth_write_enabled: Some(false),
        depth_compare: Some(compare),
        stencil,
        bias,
    }
}

/// Writes the depth of what is nearest to the eye or the light.
pub fn nearest(format: wgpu::TextureFormat) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format,
        depth_write_enabled: Some(true),
        depth_compare: Some(wgpu::CompareFunction::Greater),
        stencil: Default::default(),
        bias: Default::default(),
    }
}
