//! Surface pass: radiance of every visible point, with the light of the vertices.

use std::collections::HashMap;

use super::Look;
use super::shadow::few_lights::{self, FewLights, Kinds};
use super::surface_variant::Variant;
use crate::gpu::material_buffers::material_layout;
use crate::gpu::scene_buffers::Batch;
use crate::gpu::targets::Targets;
use crate::gpu::{Gpu, SceneBuffers, shaders};

/// Surface pass.
pub struct SurfacePass {
    source: DirectSource,
    layout: wgpu::PipelineLayout,
    module: wgpu::ShaderModule,
    samples: u32,
    /// Made when they are first needed.
    pipelines: HashMap<(Variant, Option<Kinds>), wgpu::RenderPipeline>,
    /// Of bind group 3, where there is one.
    direct_layout: Option<wgpu::BindGroupLayout>,
}

/// Where direct light comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DirectSource {
    /// The vertices, as baked.
    Stored,
    /// A texture of irradiance, one value a pixel.
    Pixels,
    /// A texture of irradiance with several samples a pixel.
    Samples,
    /// A few light samples, in the shadows of their maps.
    Few,
}

/// The direct light itself, as [`DirectSource`] promised.
pub enum Direct<'a> {
    /// That of the vertices.
    Stored,
    /// Irradiance at the pixels or their samples.
    Texture(&'a wgpu::TextureView),
    /// Those light samples.
    Few(&'a FewLights),
}

impl DirectSource {
    fn shader(self) -> &'static shaders::Shader {
        match self {
            DirectSource::Stored => &shaders::SURFACE,
            DirectSource::Pixels => &shaders::SURFACE_LIT,
            DirectSource::Samples => &shaders::SURFACE_LIT_SAMPLES,
            DirectSource::Few => &shaders::SURFACE_FEW_LIGHTS,
        }
    }

    fn layout(self, gpu: &Gpu) -> Option<wgpu::BindGroupLayout> {
        match self {
            DirectSource::Stored => None,
            DirectSource::Pixels => Some(texture_layout(gpu, false)),
            DirectSource::Samples => Some(texture_layout(gpu, true)),
            DirectSource::Few => Some(few_lights::layout(gpu)),
        }
    }
}

fn texture_layout(gpu: &Gpu, multisampled: bool) -> wgpu::BindGroupLayout {
    let texture = wgpu::BindGroupLayoutEntry {
        binding: 0,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty: wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: false },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled,
        },
        count: None,
    };
    let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some("direct irradiance"), entries: &[texture] };
    gpu.device.create_bind_group_layout(&descriptor)
}

impl SurfacePass {
    /// A pass for HDR targets with `samples` samples a pixel, and for direct light from `source`.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout, samples: u32, source: DirectSource) -> Self {
        let direct_layout = source.layout(gpu);
        let module = source.shader().module(&gpu.device);
        let material = material_layout(gpu);
        let mut layouts = vec![Some(frame_layout), None, Some(&material)];
        layouts.extend(direct_layout.as_ref().map(Some));
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("surface"),
            bind_group_layouts: &layouts,
            immediate_size: 0,
        });
        Self { source, layout, module, samples, pipelines: HashMap::new(), direct_layout }
    }

    /// Clears the targets and draws the scene into them, its vertices in `light`.
    #[expect(clippy::too_many_arguments, reason = "where to draw (encoder, targets) and what of it")]
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        targets: &Targets,
        frame: &wgpu::BindGroup,
        scene: &SceneBuffers,
        light: &wgpu::Buffer,
        look: &Look,
        direct: &Direct<'_>,
    ) {
        let kinds = match direct {
            Direct::Few(lights) => Some(lights.kinds),
            Direct::Stored | Direct::Texture(_) => None,
        };
        let variant = |batch: &Batch| (Variant::new(batch, look), kinds);
        for needed in scene.batches.iter().map(variant) {
            if !self.pipelines.contains_key(&needed) {
                self.pipelines.insert(needed, self.pipeline(gpu, needed));
            }
        }
        let direct = self.bind(gpu, direct);
        let mut pass = begin(encoder, targets);
        if direct.is_some() {
            pass.set_bind_group(3, &direct, &[]);
        }
        pass.set_bind_group(0, frame, &[]);
        if !scene.batches.is_empty() {
            pass.set_vertex_buffer(0, scene.vertices.slice(..));
            pass.set_vertex_buffer(1, light.slice(..));
            pass.set_index_buffer(scene.indices.slice(..), wgpu::IndexFormat::Uint32);
        }
        for batch in &scene.batches {
            pass.set_pipeline(&self.pipelines[&variant(batch)]);
            pass.set_bind_group(2, &scene.materials[batch.material.index()], &[]);
            pass.draw_indexed(batch.indices.clone(), 0, 0..1);
        }
    }

    fn bind(&self, gpu: &Gpu, direct: &Direct<'_>) -> Option<wgpu::BindGroup> {
        match direct {
            Direct::Stored => None,
            Direct::Few(lights) => Some(lights.bindings.clone()),
            Direct::Texture(view) => self.direct_layout.as_ref().map(|layout| {
                gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                    label: Some("direct irradiance"),
                    layout,
                    entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(view) }],
                })
            }),
        }
    }

    fn pipeline(&self, gpu: &Gpu, (variant, kinds): (Variant, Option<Kinds>)) -> wgpu::RenderPipeline {
        let mut constants: Vec<_> = kinds.iter().flat_map(Kinds::constants).collect();
        if self.source == DirectSource::Few {
            constants.push(("ONE_SAMPLE", f64::from(u8::from(self.samples == 1))));
        }
        constants.push(("LIT_BY_LIGHTS", f64::from(u8::from(self.source != DirectSource::Stored))));
        variant.pipeline(gpu, &self.layout, &self.module, self.samples, constants)
    }
}

/// Begins the pass with nothing drawn: no light, no coverage, infinitely far.
fn begin<'e>(encoder: &'e mut wgpu::CommandEncoder, targets: &Targets) -> wgpu::RenderPass<'e> {
    let (view, resolve_target) = match &targets.samples {
        Some(samples) => (samples, Some(&targets.hdr_view)),
        None => (&targets.hdr_view, None),
    };
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("surface"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store },
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &targets.depth,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
            stencil_ops: None,
        }),
        ..Default::default()
    })
}
