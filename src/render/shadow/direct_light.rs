//! Direct light pass: adds one light sample wherever it is not in shadow.

use super::light_targets::{LightTargets, irradiance_format};
use super::pipeline::{PipelineRecipe, against_depth, culling};
use super::solid::SolidPipelines;
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::RenderSettings;
use crate::render::scene::SceneBuffers;

/// Direct light of one sample where the stencil lets it pass.
pub(in crate::render) const DIRECT_LIGHT: Shader = shader!(
    "direct light",
    "shared/frame.wgsl",
    "shared/facet.wgsl",
    "shared/light_sample.wgsl",
    "shared/one_light.wgsl",
    "shared/lit_point.wgsl",
    "shared/visibility_stencil.wgsl",
    "direct_light.wgsl"
);

/// Which stencil values are lit, and how.
#[derive(Clone, Copy, Debug)]
pub struct Lit {
    /// Bits of the stencil that are looked at.
    pub read_mask: u32,
    /// How they compare with `reference`.
    pub compare: wgpu::CompareFunction,
    /// What they are compared with.
    pub reference: u32,
    /// Light is added, or taken away again.
    pub operation: wgpu::BlendOperation,
}

/// Light is added where no shadow is counted.
pub const WHERE_UNSHADOWED: Lit =
    Lit { read_mask: !0, compare: wgpu::CompareFunction::Equal, reference: 0, operation: wgpu::BlendOperation::Add };

/// Direct light pass.
pub struct DirectLightPass {
    pipelines: SolidPipelines,
    reference: u32,
}

impl DirectLightPass {
    /// Pipelines for targets with `samples` samples a pixel, with a shader that tells `visibility` its own way, and its constants.
    pub fn new(
        gpu: &Gpu,
        layouts: &[Option<&wgpu::BindGroupLayout>],
        (shader, constants): (&Shader, &[(&str, f64)]),
        samples: u32,
        lit: &Lit,
    ) -> Self {
        let module = shader.module(gpu);
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("direct light"),
            bind_group_layouts: layouts,
            immediate_size: 0,
        });
        let pipelines = SolidPipelines::new(|cull| pipeline(gpu, (&layout, &module, constants), samples, lit, cull));
        Self { pipelines, reference: lit.reference }
    }

    /// Draws within a pass that [`begin`] has begun and to which all bind groups are set.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, scene: &SceneBuffers, settings: &RenderSettings) {
        pass.set_stencil_reference(self.reference);
        self.pipelines.draw(pass, scene, settings);
    }
}

/// Takes all light away.
pub fn clear(encoder: &mut wgpu::CommandEncoder, targets: &LightTargets) {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("no light"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &targets.irradiance_view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store },
        })],
        ..Default::default()
    });
}

/// Begins a pass that marks shadows in the stencil, with none marked yet.
pub fn begin_stencil<'e>(encoder: &'e mut wgpu::CommandEncoder, targets: &LightTargets) -> wgpu::RenderPass<'e> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("shadow stencil"),
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &targets.depth_stencil,
            depth_ops: None,
            stencil_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0), store: wgpu::StoreOp::Store }),
        }),
        ..Default::default()
    })
}

/// Begins a pass that adds light.
pub fn begin<'e>(encoder: &'e mut wgpu::CommandEncoder, targets: &LightTargets) -> wgpu::RenderPass<'e> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("direct light"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &targets.irradiance_view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &targets.depth_stencil,
            depth_ops: None,
            stencil_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store }),
        }),
        ..Default::default()
    })
}

fn pipeline(
    gpu: &Gpu,
    (layout, module, constants): (&wgpu::PipelineLayout, &wgpu::ShaderModule, &[(&str, f64)]),
    samples: u32,
    lit: &Lit,
    cull_mode: Option<wgpu::Face>,
) -> wgpu::RenderPipeline {
    // What is lit once is marked, so that a surface in the same place twice is not lit twice.
    let face = wgpu::StencilFaceState {
        compare: lit.compare,
        fail_op: wgpu::StencilOperation::Keep,
        depth_fail_op: wgpu::StencilOperation::Keep,
        pass_op: wgpu::StencilOperation::IncrementClamp,
    };
    let stencil = wgpu::StencilState { front: face, back: face, read_mask: lit.read_mask, write_mask: !0 };
    let sum = wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::One,
        operation: lit.operation,
    };
    let target = wgpu::ColorTargetState {
        format: irradiance_format(gpu, samples),
        blend: Some(wgpu::BlendState { color: sum, alpha: sum }),
        write_mask: wgpu::ColorWrites::ALL,
    };
    PipelineRecipe {
        constants,
        fragment: Some(("fragment", &[Some(target)])),
        primitive: culling(cull_mode),
        depth_stencil: Some(against_depth(gpu, wgpu::CompareFunction::Equal, stencil, Default::default())),
        samples,
        ..PipelineRecipe::new("direct light", layout, module)
    }
    .make(gpu)
}
