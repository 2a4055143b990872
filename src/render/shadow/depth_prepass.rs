//! Depth prepass: which surfaces are visible, before light is added to them.

use super::light_targets::{LightTargets, depth_stencil_format};
use super::pipeline::{PipelineRecipe, culling, nearest};
use super::solid::{SolidPipelines, bind_mesh, solid_batches};
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::RenderSettings;
use crate::render::scene::SceneBuffers;
use crate::render::scene::materials::material_layout;
use crate::scene::AlphaMode;

/// Depth of the visible surfaces.
pub(in crate::render) const DEPTH_PREPASS: Shader =
    shader!("depth prepass", "shared/frame.wgsl", "shared/material.wgsl", "depth_prepass.wgsl");

/// Depth prepass.
pub struct DepthPrepass {
    opaque: SolidPipelines,
    mask: SolidPipelines,
}

impl DepthPrepass {
    /// Pipelines for targets with `samples` samples a pixel.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout, samples: u32) -> Self {
        let module = DEPTH_PREPASS.module(gpu);
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("depth prepass"),
            bind_group_layouts: &[Some(frame_layout), None, Some(&material_layout(gpu))],
            immediate_size: 0,
        });
        let pipelines = |is_mask| SolidPipelines::new(|cull| pipeline(gpu, &layout, &module, samples, is_mask, cull));
        Self { opaque: pipelines(false), mask: pipelines(true) }
    }

    /// Clears the depth and draws the solid surfaces into it.
    pub fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        targets: &LightTargets,
        frame: &wgpu::BindGroup,
        scene: &SceneBuffers,
        settings: &RenderSettings,
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("depth prepass"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &targets.depth_stencil,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Store }),
                stencil_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0), store: wgpu::StoreOp::Store }),
            }),
            ..Default::default()
        });
        pass.set_bind_group(0, frame, &[]);
        bind_mesh(&mut pass, scene);
        for batch in solid_batches(scene) {
            let has_holes = matches!(batch.alpha_mode, AlphaMode::Mask { .. });
            let pipelines = if has_holes { &self.mask } else { &self.opaque };
            pass.set_pipeline(pipelines.of(batch, settings));
            pass.set_bind_group(2, &scene.materials[batch.material.index()], &[]);
            pass.draw_indexed(batch.indices.clone(), 0, 0..1);
        }
    }
}

fn pipeline(
    gpu: &Gpu,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    samples: u32,
    is_mask: bool,
    cull_mode: Option<wgpu::Face>,
) -> wgpu::RenderPipeline {
    PipelineRecipe {
        // `ALPHA_MASK` of the shader.
        constants: &[("ALPHA_MODE", 1.0)],
        fragment: is_mask.then_some(("fragment", &[])),
        primitive: culling(cull_mode),
        depth_stencil: Some(nearest(depth_stencil_format(gpu))),
        samples,
        ..PipelineRecipe::new("depth prepass", layout, module)
    }
    .make(gpu)
}
