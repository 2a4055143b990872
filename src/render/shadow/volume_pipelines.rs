//! Pipelines that count shadow volumes in the stencil.

use glam::Vec4;

use super::light_targets::depth_stencil_format;
use super::silhouette::Counting;
use crate::gpu::Gpu;

/// A side begins at the edge of what throws the shadow, where both are equally deep but for rounding, and a cap lies in
/// its triangle: there the volume must be behind what is seen. It is moved away from the eye by as much as its depth
/// changes over a 128th of a pixel, more than the raster moves corners to its grid.
const DEEPER: wgpu::DepthBiasState = wgpu::DepthBiasState { constant: -4, slope_scale: -1.0 / 128.0, clamp: 0.0 };

/// Pipelines for triangles that are counter-clockwise seen from outside, and for those that are clockwise.
pub struct VolumePipelines {
    /// Depth-pass.
    pub pass: [wgpu::RenderPipeline; 2],
    /// Depth-fail.
    pub fail: [wgpu::RenderPipeline; 2],
    /// Darkens visible triangles, seen from outside.
    pub terminator: [wgpu::RenderPipeline; 2],
}

impl VolumePipelines {
    /// For targets with `samples` samples a pixel; a `far_depth` cuts volumes off.
    pub fn new(
        gpu: &Gpu,
        layout: &wgpu::PipelineLayout,
        module: &wgpu::ShaderModule,
        samples: u32,
        far_depth: Option<f32>,
    ) -> Self {
        let both = |make: &dyn Fn(wgpu::FrontFace) -> wgpu::RenderPipeline| {
            [wgpu::FrontFace::Ccw, wgpu::FrontFace::Cw].map(make)
        };
        let counts = |counting| {
            both(&|front_face| {
                let primitive = wgpu::PrimitiveState { front_face, cull_mode: None, ..Default::default() };
                pipeline(gpu, layout, module, samples, far_depth, primitive, counted(gpu, counting))
            })
        };
        let darkens = |front_face| {
            let cull_mode = Some(wgpu::Face::Back);
            let primitive = wgpu::PrimitiveState { front_face, cull_mode, ..Default::default() };
            pipeline(gpu, layout, module, samples, None, primitive, darkened(gpu))
        };
        Self { pass: counts(Counting::DepthPass), fail: counts(Counting::DepthFail), terminator: both(&darkens) }
    }
}

/// Counts on the two faces: depth-pass goes into a volume through a front, depth-fail through a back.
fn counted(gpu: &Gpu, counting: Counting) -> wgpu::DepthStencilState {
    use wgpu::StencilOperation::{DecrementWrap, IncrementWrap, Keep};
    let (front, back) = match counting {
        Counting::DepthPass => (face(Keep, IncrementWrap), face(Keep, DecrementWrap)),
        Counting::DepthFail => (face(DecrementWrap, Keep), face(IncrementWrap, Keep)),
    };
    depth_stencil(gpu, wgpu::CompareFunction::Greater, [front, back], DEEPER)
}

/// Marks what is visible.
fn darkened(gpu: &Gpu) -> wgpu::DepthStencilState {
    let mark = face(wgpu::StencilOperation::Keep, wgpu::StencilOperation::Replace);
    depth_stencil(gpu, wgpu::CompareFunction::Equal, [mark; 2], Default::default())
}

fn face(depth_fail_op: wgpu::StencilOperation, pass_op: wgpu::StencilOperation) -> wgpu::StencilFaceState {
    let (compare, fail_op) = (wgpu::CompareFunction::Always, wgpu::StencilOperation::Keep);
    wgpu::StencilFaceState { compare, fail_op, depth_fail_op, pass_op }
}

fn depth_stencil(
    gpu: &Gpu,
    compare: wgpu::CompareFunction,
    [front, back]: [wgpu::StencilFaceState; 2],
    bias: wgpu::DepthBiasState,
) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: depth_stencil_format(gpu),
        depth_write_enabled: Some(false),
        depth_compare: Some(compare),
        stencil: wgpu::StencilState { front, back, read_mask: !0, write_mask: !0 },
        bias,
    }
}

fn pipeline(
    gpu: &Gpu,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    samples: u32,
    far_depth: Option<f32>,
    primitive: wgpu::PrimitiveState,
    depth_stencil: wgpu::DepthStencilState,
) -> wgpu::RenderPipeline {
    let constants = [("FAR_DEPTH", f64::from(far_depth.unwrap_or(0.0)))];
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("shadow volume"),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: size_of::<Vec4>() as u64,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Float32x4],
            })],
        },
        primitive,
        depth_stencil: Some(depth_stencil),
        multisample: wgpu::MultisampleState { count: samples, ..Default::default() },
        fragment: far_depth.map(|_| wgpu::FragmentState {
            module,
            entry_point: Some("beyond"),
            compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
            targets: &[],
        }),
        multiview_mask: None,
        cache: None,
    })
}
