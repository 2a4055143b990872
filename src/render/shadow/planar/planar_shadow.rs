//! Planar shadow pass: marks in the stencil which points are on a receiver, and which of them are in shadow.
//!
//! The stencil holds the number of a point's receiver in its upper five bits and counts shadows in the lower three (see
//! [`stencil`](crate::render::shadow::shared::stencil)). [`PlanarSettings`] has a remedy for each fault of the textbook
//! method.

use glam::Vec4;
use wgpu::util::DeviceExt;

use super::flattening::flattened;
use super::receivers::{Receiver, receivers};
use super::settings::PlanarSettings;
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::shadow::light::pass_setup::PassSetup;
use crate::render::shadow::shared::frame_context::FrameContext;
use crate::render::shadow::shared::pipeline::{CORNER, PipelineRecipe, against_depth, pipeline_layout};
use crate::render::shadow::shared::stencil::{
    FIRST_RECEIVER, MAX_RECEIVERS, RECEIVER_BITS, SHADOW_BITS, both_faces, on_pass,
};

const PLANAR_SHADOW: Shader = shader!("planar shadow", "shared/frame.wgsl", "shadow/planar/planar_shadow.wgsl");
/// Depth bias of shadows that may extend beyond their receivers. It lifts them above the receivers.
const LIFT: wgpu::DepthBiasState = wgpu::DepthBiasState { constant: 16, slope_scale: 1.0, clamp: 0.0 };
/// A corner lies in a plane if its distance from the plane is at most this share of the scene's extent.
const CLEARANCE: f32 = 2e-5;

/// Planar shadow pass.
pub struct PlanarShadowPass {
    layout: wgpu::PipelineLayout,
    module: wgpu::ShaderModule,
    samples: u32,
    mark: wgpu::RenderPipeline,
    /// Pipeline of shadows, and the settings that it was created for.
    shadow: Option<(PlanarSettings, wgpu::RenderPipeline)>,
    receivers: Vec<(Receiver, wgpu::Buffer)>,
}

impl PlanarShadowPass {
    /// Creates pipelines. They use only the bind group of the frame.
    pub fn new(gpu: &Gpu, setup: &PassSetup) -> Self {
        let (module, samples) = (PLANAR_SHADOW.module(gpu), setup.samples);
        let layout = pipeline_layout(gpu, "planar shadow", &[Some(&setup.frame_layout)]);
        let tests = against_depth(gpu, wgpu::CompareFunction::Equal, mark_stencil(), Default::default());
        let mark = pipeline(gpu, &layout, &module, samples, tests);
        Self { layout, module, samples, mark, shadow: None, receivers: Vec::new() }
    }

    /// Chooses the receivers of a scene.
    pub fn prepare(&mut self, frame: FrameContext<'_>, settings: &PlanarSettings) {
        let (gpu, scene) = (frame.gpu, frame.shadows.scene());
        let upload = |receiver: Receiver| {
            let corners: Vec<Vec4> =
                receiver.triangles.iter().flat_map(|&id| scene.corners(id)).map(|corner| corner.extend(1.0)).collect();
            let buffer = vertex_buffer(gpu, &corners);
            (receiver, buffer)
        };
        self.receivers = receivers(scene, settings).into_iter().take(MAX_RECEIVERS).map(upload).collect();
        if self.shadow.as_ref().is_none_or(|(known, _)| known != settings) {
            let (compare, bias) = match (settings.is_free_of_depth, settings.stays_on_receiver) {
                (true, true) => (wgpu::CompareFunction::Always, Default::default()),
                (true, false) => (wgpu::CompareFunction::GreaterEqual, LIFT),
                (false, _) => (wgpu::CompareFunction::GreaterEqual, Default::default()),
            };
            let tests = against_depth(gpu, compare, shadow_stencil(settings), bias);
            let pipeline = pipeline(gpu, &self.layout, &self.module, self.samples, tests);
            self.shadow = Some((settings.clone(), pipeline));
        }
    }

    /// Marks the shadows of a light at a homogeneous position. The stencil of the pass must be cleared and bind group 0
    /// set.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, frame: FrameContext<'_>, light: Vec4) {
        let (settings, shadow) = self.shadow.as_ref().expect("receivers have been chosen");
        let clearance = CLEARANCE * frame.shadows.bounds().extent();
        for ((receiver, corners), number) in self.receivers.iter().zip(1..) {
            pass.set_stencil_reference(FIRST_RECEIVER * number);
            draw(pass, &self.mark, corners);
            // A light behind the plane does not reach it.
            if receiver.plane.dot(light) <= clearance * light.w {
                continue;
            }
            let shadows = flattened(frame.shadows.casters(), receiver.plane, light, settings, clearance);
            if !shadows.is_empty() {
                pass.set_stencil_reference(FIRST_RECEIVER * number + 1);
                draw(pass, shadow, &vertex_buffer(frame.gpu, &shadows));
            }
        }
    }
}

fn draw(pass: &mut wgpu::RenderPass<'_>, pipeline: &wgpu::RenderPipeline, corners: &wgpu::Buffer) {
    pass.set_pipeline(pipeline);
    pass.set_vertex_buffer(0, corners.slice(..));
    pass.draw(0..(corners.size() / size_of::<Vec4>() as u64) as u32, 0..1);
}

fn vertex_buffer(gpu: &Gpu, corners: &[Vec4]) -> wgpu::Buffer {
    gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("planar shadow"),
        contents: bytemuck::cast_slice(corners),
        usage: wgpu::BufferUsages::VERTEX,
    })
}

/// Returns the state that writes the receiver's number where the receiver is visible.
fn mark_stencil() -> wgpu::StencilState {
    both_faces(on_pass(wgpu::CompareFunction::Always, wgpu::StencilOperation::Replace), !0, RECEIVER_BITS)
}

/// Returns the state that counts a shadow on the points of one receiver: those with its number, given by the reference
/// value.
fn shadow_stencil(settings: &PlanarSettings) -> wgpu::StencilState {
    use wgpu::CompareFunction::{Always, Equal};
    use wgpu::StencilOperation::{IncrementClamp, Replace};
    let compare = if settings.stays_on_receiver { Equal } else { Always };
    let operation = if settings.darkens_once { Replace } else { IncrementClamp };
    both_faces(on_pass(compare, operation), RECEIVER_BITS, SHADOW_BITS)
}

fn pipeline(
    gpu: &Gpu,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    samples: u32,
    depth_stencil: wgpu::DepthStencilState,
) -> wgpu::RenderPipeline {
    PipelineRecipe {
        vertex: Some(CORNER),
        depth_stencil: Some(depth_stencil),
        samples,
        ..PipelineRecipe::new("planar shadow", layout, module)
    }
    .make(gpu)
}
