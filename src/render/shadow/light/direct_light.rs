//! Direct light pass: adds the irradiance of one light sample wherever the stencil marks no shadow.

use super::sample_context::SampleContext;
use super::targets::{LightTargets, irradiance_format};
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::shadow::shared::frame_context::FrameContext;
use crate::render::shadow::shared::pipeline::{PipelineRecipe, against_depth, culling, pipeline_layout};
use crate::render::shadow::shared::solid_surfaces::SolidPipelines;
use crate::render::shadow::shared::stencil::{both_faces, on_pass};

/// Shader that adds direct light where the stencil test passes.
pub const DIRECT_LIGHT: Shader = shader!(
    "direct light",
    "shared/frame.wgsl",
    "shadow/light/facet.wgsl",
    "shadow/light/light_sample.wgsl",
    "shadow/light/one_light.wgsl",
    "shadow/light/lit_point.wgsl",
    "shadow/light/stencil_visibility.wgsl",
    "shadow/light/direct_light.wgsl"
);

/// Selects the stencil values that receive light, and whether it is added or subtracted.
#[derive(Clone, Copy, Debug)]
pub struct LightBlend {
    /// Bits of the stencil that are compared.
    pub read_mask: u32,
    /// The test: `reference` compared with the stencil.
    pub compare: wgpu::CompareFunction,
    /// Reference value of the test.
    pub reference: u32,
    /// `Add`, or `ReverseSubtract` to subtract light.
    pub operation: wgpu::BlendOperation,
}

/// Adds light where the stencil is zero.
pub const LIGHT_UNSHADOWED: LightBlend = LightBlend {
    read_mask: !0,
    compare: wgpu::CompareFunction::Equal,
    reference: 0,
    operation: wgpu::BlendOperation::Add,
};

/// Direct light pass.
pub struct DirectLightPass {
    pipelines: SolidPipelines,
    reference: u32,
}

impl DirectLightPass {
    /// Creates pipelines for targets with `samples` samples a pixel. `shader` is a module with a function `visibility`,
    /// and the values of the module's constants.
    pub fn new(
        gpu: &Gpu,
        groups: &[Option<&wgpu::BindGroupLayout>],
        (shader, constants): (&Shader, &[(&str, f64)]),
        samples: u32,
        blend: &LightBlend,
    ) -> Self {
        let module = shader.module(gpu);
        let layout = pipeline_layout(gpu, "direct light", groups);
        // A lit point is marked too, so that only one of two coincident surfaces is lit.
        let lit = on_pass(blend.compare, wgpu::StencilOperation::IncrementClamp);
        let stencil = both_faces(lit, blend.read_mask, !0);
        let target = wgpu::ColorTargetState {
            format: irradiance_format(gpu, samples),
            blend: Some(sum(blend.operation)),
            write_mask: wgpu::ColorWrites::ALL,
        };
        let pipelines = SolidPipelines::new(|cull_mode| {
            PipelineRecipe {
                constants,
                fragment: Some(("fragment", &[Some(target.clone())])),
                primitive: culling(cull_mode),
                depth_stencil: Some(against_depth(
                    gpu,
                    wgpu::CompareFunction::Equal,
                    stencil.clone(),
                    Default::default(),
                )),
                samples,
                ..PipelineRecipe::new("direct light", &layout, &module)
            }
            .make(gpu)
        });
        Self { pipelines, reference: blend.reference }
    }

    /// Draws the surfaces in view, within a pass from [`begin`] with all bind groups set.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, frame: FrameContext<'_>) {
        pass.set_stencil_reference(self.reference);
        self.pipelines.draw(pass, frame.in_view, frame.render_settings);
    }
}

/// Returns the blend state for target + source, or for target - source.
fn sum(operation: wgpu::BlendOperation) -> wgpu::BlendState {
    let (src_factor, dst_factor) = (wgpu::BlendFactor::One, wgpu::BlendFactor::One);
    let component = wgpu::BlendComponent { src_factor, dst_factor, operation };
    wgpu::BlendState { color: component, alpha: component }
}

/// Clears the irradiance of a picture.
pub fn clear(encoder: &mut wgpu::CommandEncoder, targets: &LightTargets) {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("clear direct light"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &targets.irradiance_view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store },
        })],
        ..Default::default()
    });
}

/// Begins a pass that marks shadows in a cleared stencil, with bind groups 0 and 1 set.
pub fn begin_stencil<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    targets: &LightTargets,
    sample: SampleContext<'_>,
) -> wgpu::RenderPass<'e> {
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("shadow stencil"),
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &targets.depth_stencil,
            depth_ops: None,
            stencil_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0), store: wgpu::StoreOp::Store }),
        }),
        ..Default::default()
    });
    sample.bind(&mut pass);
    pass
}

/// Begins a pass that adds the light of a sample, with bind groups 0 and 1 set.
pub fn begin<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    targets: &LightTargets,
    sample: SampleContext<'_>,
) -> wgpu::RenderPass<'e> {
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
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
    });
    sample.bind(&mut pass);
    pass
}
