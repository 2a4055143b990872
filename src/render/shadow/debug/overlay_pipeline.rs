//! Passes and pipelines that colour the pixels of a finished picture.

use crate::gpu::Gpu;
use crate::gpu::shader::Shader;
use crate::render::shadow::shared::pipeline::{PipelineRecipe, pipeline_layout};

/// Begins a pass that draws over a picture.
pub fn begin<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    target: &wgpu::TextureView,
    load: wgpu::LoadOp<wgpu::Color>,
) -> wgpu::RenderPass<'e> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("shadow debug"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: target,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
        })],
        ..Default::default()
    })
}

/// Creates a pipeline that draws one triangle over the whole picture, with one `override` constant.
pub fn pipeline(
    gpu: &Gpu,
    shader: &Shader,
    layouts: &[Option<&wgpu::BindGroupLayout>],
    output_format: wgpu::TextureFormat,
    constant: (&str, f64),
) -> wgpu::RenderPipeline {
    let layout = pipeline_layout(gpu, shader.name, layouts);
    let target = wgpu::ColorTargetState {
        format: output_format,
        blend: Some(wgpu::BlendState::ALPHA_BLENDING),
        write_mask: wgpu::ColorWrites::ALL,
    };
    PipelineRecipe {
        constants: &[constant, ("TARGET_ENCODES", f64::from(u8::from(output_format.is_srgb())))],
        vertex: None,
        fragment: Some(("fragment", &[Some(target)])),
        ..PipelineRecipe::new(shader.name, &layout, &shader.module(gpu))
    }
    .make(gpu)
}
