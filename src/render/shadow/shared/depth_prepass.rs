//! Depth prepass: finds which surfaces are visible, before light is added to them.

use super::frame_context::FrameContext;
use super::pipeline::{PipelineRecipe, culling, depth_stencil_format, nearest, pipeline_layout};
use super::solid_surfaces::{SolidPipelines, bind_mesh, solid_batches};
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::scene::materials::material_layout;
use crate::scene::AlphaMode;

const DEPTH_PREPASS: Shader =
    shader!("depth prepass", "shared/frame.wgsl", "shared/material.wgsl", "shadow/shared/depth_prepass.wgsl");
/// `ALPHA_MASK` of shaders/shared/material.wgsl.
const ALPHA_MASK: f64 = 1.0;

/// Depth prepass.
pub struct DepthPrepass {
    opaque: SolidPipelines,
    mask: SolidPipelines,
}

impl DepthPrepass {
    /// Creates pipelines for targets with `samples` samples a pixel.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout, samples: u32) -> Self {
        let module = DEPTH_PREPASS.module(gpu);
        let groups = [Some(frame_layout), None, Some(&material_layout(gpu))];
        let layout = pipeline_layout(gpu, "depth prepass", &groups);
        let pipelines = |is_mask: bool| {
            SolidPipelines::new(|cull_mode| {
                PipelineRecipe {
                    constants: &[("ALPHA_MODE", ALPHA_MASK)],
                    fragment: is_mask.then_some(("fragment", &[])),
                    primitive: culling(cull_mode),
                    depth_stencil: Some(nearest(depth_stencil_format(gpu))),
                    samples,
                    ..PipelineRecipe::new("depth prepass", &layout, &module)
                }
                .make(gpu)
            })
        };
        Self { opaque: pipelines(false), mask: pipelines(true) }
    }

    /// Clears depth and stencil and draws the solid surfaces in view.
    pub fn draw(&self, encoder: &mut wgpu::CommandEncoder, depth_stencil: &wgpu::TextureView, frame: FrameContext<'_>) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("depth prepass"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: depth_stencil,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Store }),
                stencil_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0), store: wgpu::StoreOp::Store }),
            }),
            ..Default::default()
        });
        let scene = frame.in_view;
        pass.set_bind_group(0, frame.bindings, &[]);
        bind_mesh(&mut pass, scene);
        for batch in solid_batches(scene) {
            let has_holes = matches!(batch.alpha_mode, AlphaMode::Mask { .. });
            let pipelines = if has_holes { &self.mask } else { &self.opaque };
            pass.set_pipeline(pipelines.of(batch, frame.render_settings));
            pass.set_bind_group(2, &scene.materials[batch.material.index()], &[]);
            pass.draw_indexed(batch.indices.clone(), 0, 0..1);
        }
    }
}
