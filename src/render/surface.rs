//! Surface pass: radiance of every visible point, with the light of the vertices.

use std::collections::HashMap;

use super::Look;
use super::shadow::few_lights::{self, Kinds};
use super::shadow::real_time::LiveLight;
use super::surface_variant::{Output, Variant};
use crate::base::colour::srgb_from_linear;
use crate::gpu::material_buffers::material_layout;
use crate::gpu::scene_buffers::Batch;
use crate::gpu::targets::Targets;
use crate::gpu::{Gpu, SceneBuffers, shaders};

/// Pipelines that are kept; those of a look are a few, and a software driver keeps a megabyte for each.
const MOST_PIPELINES: usize = 32;

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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
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

impl DirectSource {
    /// Where it comes from with this light of the lights themselves.
    pub fn of(live: Option<&LiveLight>) -> Self {
        match live {
            None => DirectSource::Stored,
            Some(LiveLight::Pixels(_)) => DirectSource::Pixels,
            Some(LiveLight::Samples(_)) => DirectSource::Samples,
            Some(LiveLight::Few(_)) => DirectSource::Few,
        }
    }

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

/// What is drawn into, all of one size.
pub struct SurfaceTargets<'a> {
    /// Radiance or what is displayed, as `output` says.
    pub colour: &'a wgpu::TextureView,
    /// Where the mean of the samples goes.
    pub resolve: Option<&'a wgpu::TextureView>,
    /// Depth.
    pub depth: &'a wgpu::TextureView,
    /// What is drawn.
    pub output: Output,
    /// Colour where nothing is seen.
    pub background: wgpu::Color,
}

impl<'a> SurfaceTargets<'a> {
    /// Radiance, with no light and no coverage where nothing is seen.
    pub fn radiance(targets: &'a Targets) -> Self {
        let (colour, resolve) = match &targets.samples {
            Some(samples) => (samples, Some(&targets.hdr_view)),
            None => (&targets.hdr_view, None),
        };
        let background = wgpu::Color::TRANSPARENT;
        Self { colour, resolve, depth: &targets.depth, output: Output::Radiance, background }
    }

    /// What is displayed, with the background of `look`, into a target of `format`.
    pub fn display(
        target: &'a wgpu::TextureView,
        format: wgpu::TextureFormat,
        targets: &'a Targets,
        look: &Look,
    ) -> Self {
        let encoded = |linear| if format.is_srgb() { linear } else { srgb_from_linear(linear) };
        let [r, g, b] = look.background.to_array().map(|channel| f64::from(encoded(channel.clamp(0.0, 1.0))));
        Self {
            colour: target,
            resolve: None,
            depth: &targets.depth,
            output: Output::Display(format, look.tone_map_in_force()),
            background: wgpu::Color { r, g, b, a: 1.0 },
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
    /// A pass for targets with `samples` samples a pixel, and for direct light from `source`.
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

    /// Clears the targets and draws the scene into them, its vertices in the light of `stored`.
    #[expect(clippy::too_many_arguments, reason = "where to draw (encoder, targets) and what of it")]
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        targets: &SurfaceTargets<'_>,
        frame: &wgpu::BindGroup,
        scene: &SceneBuffers,
        look: &Look,
        stored: &wgpu::Buffer,
        live: Option<&LiveLight>,
    ) {
        let kinds = match live {
            Some(LiveLight::Few(lights)) => Some(lights.kinds),
            _ => None,
        };
        let variant = |batch: &Batch| (Variant::new(batch, look, targets.output), kinds);
        if self.pipelines.len() > MOST_PIPELINES {
            self.pipelines.clear();
        }
        for needed in scene.batches.iter().map(variant) {
            if !self.pipelines.contains_key(&needed) {
                self.pipelines.insert(needed, self.pipeline(gpu, needed));
            }
        }
        let live = live.and_then(|live| self.bind(gpu, live));
        let mut pass = begin(encoder, targets);
        if live.is_some() {
            pass.set_bind_group(3, &live, &[]);
        }
        pass.set_bind_group(0, frame, &[]);
        if !scene.batches.is_empty() {
            pass.set_vertex_buffer(0, scene.vertices.slice(..));
            pass.set_vertex_buffer(1, stored.slice(..));
            pass.set_index_buffer(scene.indices.slice(..), wgpu::IndexFormat::Uint32);
        }
        for batch in &scene.batches {
            pass.set_pipeline(&self.pipelines[&variant(batch)]);
            pass.set_bind_group(2, &scene.materials[batch.material.index()], &[]);
            pass.draw_indexed(batch.indices.clone(), 0, 0..1);
        }
    }

    fn bind(&self, gpu: &Gpu, live: &LiveLight) -> Option<wgpu::BindGroup> {
        let view = match live {
            LiveLight::Few(lights) => return Some(lights.bindings.clone()),
            LiveLight::Pixels(view) | LiveLight::Samples(view) => view,
        };
        self.direct_layout.as_ref().map(|layout| {
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("direct irradiance"),
                layout,
                entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(view) }],
            })
        })
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

/// Begins the pass with nothing drawn, infinitely far.
fn begin<'e>(encoder: &'e mut wgpu::CommandEncoder, targets: &SurfaceTargets<'_>) -> wgpu::RenderPass<'e> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("surface"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: targets.colour,
            depth_slice: None,
            resolve_target: targets.resolve,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(targets.background), store: wgpu::StoreOp::Store },
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: targets.depth,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
            stencil_ops: None,
        }),
        ..Default::default()
    })
}
