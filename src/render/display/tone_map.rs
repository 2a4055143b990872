//! Tone mapping pass: converts the HDR picture to display colours and writes them to the caller's target.
//!
//! Each sample is exposed, mapped, and blended with the background, and then the samples of a pixel are averaged. In
//! this order the edges of bright lamps stay smooth. The curve itself is in `shaders/display/display_colour.wgsl`.

use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::targets::Targets;

/// Shader for pictures with one sample a pixel.
pub(in crate::render) const TONE_MAP: Shader = shader!(
    "tone map",
    "shared/frame.wgsl",
    "shared/colour.wgsl",
    "display/display_colour.wgsl",
    "display/samples_one.wgsl",
    "display/tone_map.wgsl"
);
/// Shader for pictures with several samples a pixel.
pub(in crate::render) const TONE_MAP_SAMPLES: Shader = shader!(
    "tone map, samples",
    "shared/frame.wgsl",
    "shared/colour.wgsl",
    "display/display_colour.wgsl",
    "display/samples_many.wgsl",
    "display/tone_map.wgsl"
);

/// Tone mapping pass.
pub struct ToneMapPass {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
}

impl ToneMapPass {
    /// Creates a pipeline into targets of `output_format` from HDR pictures with `samples` samples a pixel.
    pub fn new(
        gpu: &Gpu,
        frame_layout: &wgpu::BindGroupLayout,
        output_format: wgpu::TextureFormat,
        samples: u32,
    ) -> Self {
        let shader = if samples > 1 { &TONE_MAP_SAMPLES } else { &TONE_MAP };
        let module = shader.module(gpu);
        let layout = bind_group_layout(gpu, samples > 1);
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(shader.name),
            bind_group_layouts: &[Some(frame_layout), Some(&layout)],
            immediate_size: 0,
        });
        let constants = [("TARGET_ENCODES", f64::from(u8::from(output_format.is_srgb())))];
        let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(shader.name),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: Default::default(),
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fragment"),
                compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
                targets: &[Some(output_format.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        Self { layout, pipeline }
    }

    /// Fills `target`, which has the size of `targets`.
    pub fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        targets: &Targets,
        frame: &wgpu::BindGroup,
        exposure: &wgpu::Buffer,
        target: &wgpu::TextureView,
    ) {
        let hdr = targets.samples.as_ref().unwrap_or(&targets.hdr_view);
        let bindings = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("tone map"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(hdr) },
                wgpu::BindGroupEntry { binding: 1, resource: exposure.as_entire_binding() },
            ],
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("tone map"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, frame, &[]);
        pass.set_bind_group(1, &bindings, &[]);
        pass.draw(0..3, 0..1);
    }
}

fn bind_group_layout(gpu: &Gpu, multisampled: bool) -> wgpu::BindGroupLayout {
    let entry = |binding, visibility, ty| wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None };
    let hdr = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled,
    };
    let exposure = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Storage { read_only: true },
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("tone map"),
        entries: &[entry(0, wgpu::ShaderStages::FRAGMENT, hdr), entry(1, wgpu::ShaderStages::VERTEX, exposure)],
    })
}
