//! Common parts of the pipelines of all shadow passes.

use glam::Vec4;

use crate::gpu::Gpu;
use crate::render::scene::gpu_vertex::GpuVertex;

/// Vertex buffer of homogeneous corners, `vec4f` at location 0.
pub const CORNER: wgpu::VertexBufferLayout<'_> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Vec4>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x4],
};

/// Returns a depth format with a stencil of eight bits, the size that every device supports.
pub fn depth_stencil_format(gpu: &Gpu) -> wgpu::TextureFormat {
    if gpu.device.features().contains(wgpu::Features::DEPTH32FLOAT_STENCIL8) {
        wgpu::TextureFormat::Depth32FloatStencil8
    } else {
        wgpu::TextureFormat::Depth24PlusStencil8
    }
}

/// Describes a pipeline that draws triangles. The entry point of its vertex stage is `vertex`.
///
/// [`PipelineRecipe::new`] fills in the defaults: the vertices of the scene, no fragment stage, one sample a pixel.
pub struct PipelineRecipe<'a> {
    /// Label for debuggers.
    pub label: &'a str,
    /// Layout of the bind groups.
    pub layout: &'a wgpu::PipelineLayout,
    /// Shader module of both stages.
    pub module: &'a wgpu::ShaderModule,
    /// Values of the module's `override` constants.
    pub constants: &'a [(&'a str, f64)],
    /// Vertex buffer; `None` if the shader makes its own vertices.
    pub vertex: Option<wgpu::VertexBufferLayout<'a>>,
    /// Entry point of the fragment stage, and the targets that it writes.
    pub fragment: Option<(&'a str, &'a [Option<wgpu::ColorTargetState>])>,
    /// Winding and culling.
    pub primitive: wgpu::PrimitiveState,
    /// Depth and stencil tests.
    pub depth_stencil: Option<wgpu::DepthStencilState>,
    /// Samples a pixel.
    pub samples: u32,
}

impl<'a> PipelineRecipe<'a> {
    /// Describes a pipeline without fragment stage and without depth test.
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

    /// Creates the pipeline.
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

/// Creates a pipeline layout from layouts of bind groups.
pub fn pipeline_layout(gpu: &Gpu, label: &str, groups: &[Option<&wgpu::BindGroupLayout>]) -> wgpu::PipelineLayout {
    gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(label),
        bind_group_layouts: groups,
        immediate_size: 0,
    })
}

/// Returns a primitive state for triangles that culls the faces of `cull_mode`.
pub fn culling(cull_mode: Option<wgpu::Face>) -> wgpu::PrimitiveState {
    wgpu::PrimitiveState { cull_mode, ..Default::default() }
}

/// Returns a state that compares with the depth of the visible surfaces and does not write depth.
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

/// Returns a state that writes the depth of the surface nearest to the eye or the light. Depth is reversed: 1 is near,
/// 0 infinitely far.
pub fn nearest(format: wgpu::TextureFormat) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format,
        depth_write_enabled: Some(true),
        depth_compare: Some(wgpu::CompareFunction::Greater),
        stencil: Default::default(),
        bias: Default::default(),
    }
}
