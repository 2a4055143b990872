//! Pipelines that count shadow volumes in the stencil.

use super::pipeline::{CORNER, PipelineRecipe, against_depth};
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
    let stencil = wgpu::StencilState { front, back, read_mask: !0, write_mask: !0 };
    against_depth(gpu, wgpu::CompareFunction::Greater, stencil, DEEPER)
}

/// Marks what is visible.
fn darkened(gpu: &Gpu) -> wgpu::DepthStencilState {
    let mark = face(wgpu::StencilOperation::Keep, wgpu::StencilOperation::Replace);
    let stencil = wgpu::StencilState { front: mark, back: mark, read_mask: !0, write_mask: !0 };
    against_depth(gpu, wgpu::CompareFunction::Equal, stencil, Default::default())
}

fn face(depth_fail_op: wgpu::StencilOperation, pass_op: wgpu::StencilOperation) -> wgpu::StencilFaceState {
    let (compare, fail_op) = (wgpu::CompareFunction::Always, wgpu::StencilOperation::Keep);
    wgpu::StencilFaceState { compare, fail_op, depth_fail_op, pass_op }
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
    PipelineRecipe {
        constants: &[("FAR_DEPTH", f64::from(far_depth.unwrap_or(0.0)))],
        vertex: Some(CORNER),
        fragment: far_depth.map(|_| ("beyond", [].as_slice())),
        primitive,
        depth_stencil: Some(depth_stencil),
        samples,
        ..PipelineRecipe::new("shadow volume", layout, module)
    }
    .make(gpu)
}
