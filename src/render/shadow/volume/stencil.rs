//! Stencil states of shadow volumes, z-pass and z-fail, and the pipelines that count with them.
//!
//! Let the count of a pixel be the number of volumes that its visible point is in. Walking from the eye to the point,
//! each front face enters a volume and each back face leaves one, so z-pass counts faces in front of the point:
//!
//! ```text
//! z-pass:  depth test passes:  front +1, back -1       (Heidmann 1991)
//! z-fail:  depth test fails:   back  +1, front -1      (Everitt and Kilgard 2002)
//! ```
//!
//! z-fail walks from infinity to the point and counts faces behind it. Both operations wrap at 256, so the order of
//! faces does not matter. A point in a multiple of 256 volumes counts as lit.

use crate::gpu::Gpu;
use crate::render::shadow::light::pass_setup::PassSetup;
use crate::render::shadow::shared::pipeline::{CORNER, PipelineRecipe, against_depth, pipeline_layout};
use crate::render::shadow::shared::stencil::{both_faces, on_pass};

/// Depth bias of volumes, away from the eye. The sides of a volume at the caster's edges, and the cap on the caster's
/// triangle, have the depth of the surface except for rounding. There the volume must fail the depth test. The bias is
/// the volume's change of depth over a 128th of a pixel, which is more than rasterisation moves corners.
const DEEPER: wgpu::DepthBiasState = wgpu::DepthBiasState { constant: -4, slope_scale: -1.0 / 128.0, clamp: 0.0 };

/// Pipelines for counter-clockwise and clockwise triangles of a [`Hull`](super::hull::Hull).
pub struct VolumePipelines {
    /// Count by z-pass.
    pub depth_pass: [wgpu::RenderPipeline; 2],
    /// Count by z-fail.
    pub depth_fail: [wgpu::RenderPipeline; 2],
    /// Darken visible triangles.
    pub terminator: [wgpu::RenderPipeline; 2],
}

impl VolumePipelines {
    /// Creates pipelines from the module of the shadow volume pass. If `far_depth` is given, they cut volumes off
    /// beyond it.
    pub fn new(gpu: &Gpu, setup: &PassSetup, module: &wgpu::ShaderModule, far_depth: Option<f32>) -> Self {
        let layout = pipeline_layout(gpu, "shadow volume", &setup.groups());
        let both_windings = |cull_mode, depth_stencil: wgpu::DepthStencilState, far_depth: Option<f32>| {
            [wgpu::FrontFace::Ccw, wgpu::FrontFace::Cw].map(|front_face| {
                PipelineRecipe {
                    constants: &[("FAR_DEPTH", f64::from(far_depth.unwrap_or(0.0)))],
                    vertex: Some(CORNER),
                    fragment: far_depth.map(|_| ("beyond", [].as_slice())),
                    primitive: wgpu::PrimitiveState { front_face, cull_mode, ..Default::default() },
                    depth_stencil: Some(depth_stencil.clone()),
                    samples: setup.samples,
                    ..PipelineRecipe::new("shadow volume", &layout, module)
                }
                .make(gpu)
            })
        };
        Self {
            depth_pass: both_windings(None, count_state(gpu, z_pass()), far_depth),
            depth_fail: both_windings(None, count_state(gpu, z_fail()), far_depth),
            terminator: both_windings(Some(wgpu::Face::Back), darken_state(gpu), None),
        }
    }
}

/// Returns the state of z-pass: it counts where the depth test passes. A front face enters a volume, a back face leaves
/// it.
fn z_pass() -> wgpu::StencilState {
    use wgpu::StencilOperation::{DecrementWrap, IncrementWrap, Keep};
    count_faces(face(Keep, IncrementWrap), face(Keep, DecrementWrap))
}

/// Returns the state of z-fail: it counts where the depth test fails. Seen from infinity, a back face enters a volume,
/// a front face leaves it.
fn z_fail() -> wgpu::StencilState {
    use wgpu::StencilOperation::{DecrementWrap, IncrementWrap, Keep};
    count_faces(face(DecrementWrap, Keep), face(IncrementWrap, Keep))
}

fn count_faces(front: wgpu::StencilFaceState, back: wgpu::StencilFaceState) -> wgpu::StencilState {
    wgpu::StencilState { front, back, read_mask: !0, write_mask: !0 }
}

fn face(depth_fail_op: wgpu::StencilOperation, pass_op: wgpu::StencilOperation) -> wgpu::StencilFaceState {
    let (compare, fail_op) = (wgpu::CompareFunction::Always, wgpu::StencilOperation::Keep);
    wgpu::StencilFaceState { compare, fail_op, depth_fail_op, pass_op }
}

/// Compares with the depth of the visible surface. Depth is reversed, so the test passes in front of the surface.
fn count_state(gpu: &Gpu, stencil: wgpu::StencilState) -> wgpu::DepthStencilState {
    against_depth(gpu, wgpu::CompareFunction::Greater, stencil, DEEPER)
}

/// Replaces the stencil on the visible surface.
fn darken_state(gpu: &Gpu) -> wgpu::DepthStencilState {
    let replace = on_pass(wgpu::CompareFunction::Always, wgpu::StencilOperation::Replace);
    against_depth(gpu, wgpu::CompareFunction::Equal, both_faces(replace, !0, !0), Default::default())
}
