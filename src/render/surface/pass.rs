//! Surface pass: draws the radiance of every visible point, with one draw call for each batch of one material.

use super::direct_source::DirectSource;
use super::recently_used::RecentlyUsed;
use super::targets::SurfaceTargets;
use super::variant::Variant;
use crate::gpu::Gpu;
use crate::render::RenderSettings;
use crate::render::scene::SceneBuffers;
use crate::render::scene::draw_batch::DrawBatch;
use crate::render::scene::materials::material_layout;
use crate::render::shadow::few_lights::LightKinds;
use crate::render::shadow::real_time::DirectLight;
use crate::render::targets::HDR_FORMAT;

/// Largest number of cached pipelines. One picture needs a few, and a software driver keeps a megabyte for each (Mesa
/// 22.3).
const MOST_PIPELINES: usize = 16;

/// Everything that a pipeline depends on: the surface, and the kinds of a few light samples.
type PipelineKey = (Variant, Option<LightKinds>);

/// Input of the surface pass.
#[derive(Clone, Copy)]
pub struct SurfaceInput<'a> {
    /// Bind group 0.
    pub bindings: &'a wgpu::BindGroup,
    /// The triangles that may be in view.
    pub in_view: &'a SceneBuffers,
    /// Settings of the picture.
    pub settings: &'a RenderSettings,
    /// The light of the vertices, summed over the light groups.
    pub stored: &'a wgpu::Buffer,
    /// The metered exposure, for display colours without a fixed exposure.
    pub exposure: &'a wgpu::Buffer,
    /// Direct light from the lights themselves.
    pub live: Option<&'a DirectLight>,
}

/// Surface pass.
pub struct SurfacePass {
    source: DirectSource,
    layout: wgpu::PipelineLayout,
    module: wgpu::ShaderModule,
    /// The module for light in tiles, if this source of direct light can show tiles.
    tiled_module: Option<wgpu::ShaderModule>,
    samples: u32,
    /// The pipelines that were used most recently.
    pipelines: RecentlyUsed<PipelineKey, wgpu::RenderPipeline>,
    /// Layout of bind group 1.
    light_layout: wgpu::BindGroupLayout,
    /// Interpolates between texels of tiles.
    sampler: wgpu::Sampler,
    /// Placeholder that is bound if there are no tiles.
    no_tiles: wgpu::TextureView,
    /// Layout of bind group 3, if there is one.
    direct_layout: Option<wgpu::BindGroupLayout>,
}

/// Creates the layout of bind group 1: metered exposure (one f32), tiles of a coarse mesh, and their sampler.
fn light_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let entry = |binding, visibility, ty| wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None };
    let exposure = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Storage { read_only: true },
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let tiles = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: true },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("exposure and tiles"),
        entries: &[
            entry(0, wgpu::ShaderStages::VERTEX, exposure),
            entry(1, wgpu::ShaderStages::FRAGMENT, tiles),
            entry(2, wgpu::ShaderStages::FRAGMENT, sampler),
        ],
    })
}

fn no_tiles(gpu: &Gpu) -> wgpu::TextureView {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("no tiles"),
        size: wgpu::Extent3d { width: 1, height: 1, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: HDR_FORMAT,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    texture.create_view(&Default::default())
}

impl SurfacePass {
    /// Creates a pass for targets with `samples` samples a pixel, and for direct light from `source`.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout, samples: u32, source: DirectSource) -> Self {
        let direct_layout = source.layout(gpu);
        let module = source.shader().module(gpu);
        let tiled_module = source.tiled_shader().map(|shader| shader.module(gpu));
        let material = material_layout(gpu);
        let light_layout = light_layout(gpu);
        let mut layouts = vec![Some(frame_layout), Some(&light_layout), Some(&material)];
        layouts.extend(direct_layout.as_ref().map(Some));
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("surface"),
            bind_group_layouts: &layouts,
            immediate_size: 0,
        });
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("between texels of tiles"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        let no_tiles = no_tiles(gpu);
        let pipelines = RecentlyUsed::new(MOST_PIPELINES);
        Self {
            source,
            layout,
            module,
            tiled_module,
            samples,
            pipelines,
            light_layout,
            sampler,
            no_tiles,
            direct_layout,
        }
    }

    /// Clears the targets and draws the scene into them.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        targets: &SurfaceTargets<'_>,
        input: SurfaceInput<'_>,
    ) {
        let SurfaceInput { bindings, in_view: scene, settings, stored, exposure, live } = input;
        let kinds = match live {
            Some(DirectLight::Few(lights)) => Some(lights.kinds),
            _ => None,
        };
        let variant = |batch: &DrawBatch| (Variant::new(batch, settings, targets.output), kinds);
        let tiled = scene.tiled.as_ref().filter(|_| self.source.shows_tiles());
        let (indices, batches) = if tiled.is_some() { scene.coarsest() } else { (&scene.indices, &scene.batches[..]) };
        let pipelines: Vec<_> = batches.iter().map(|batch| self.pipeline(gpu, variant(batch))).collect();
        let live = live.and_then(|live| self.bind(gpu, live));
        let tiles = tiled.map_or(&self.no_tiles, |tiled| &tiled.tiles.light);
        let light = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("exposure and tiles"),
            layout: &self.light_layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: exposure.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(tiles) },
                wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Sampler(&self.sampler) },
            ],
        });
        let mut pass = targets.begin(encoder);
        if live.is_some() {
            pass.set_bind_group(3, &live, &[]);
        }
        pass.set_bind_group(0, bindings, &[]);
        pass.set_bind_group(1, &light, &[]);
        if !batches.is_empty() {
            pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
        }
        for (batch, pipeline) in batches.iter().zip(&pipelines) {
            let light = tiled.filter(|_| batch.is_tiled).map_or(stored, |tiled| &tiled.places);
            pass.set_vertex_buffer(0, scene.vertices_of(batch).slice(..));
            pass.set_vertex_buffer(1, light.slice(..));
            pass.set_pipeline(pipeline);
            pass.set_bind_group(2, &scene.materials[batch.material.index()], &[]);
            pass.draw_indexed(batch.indices.clone(), 0, 0..1);
        }
    }

    fn bind(&self, gpu: &Gpu, live: &DirectLight) -> Option<wgpu::BindGroup> {
        let view = match live {
            DirectLight::Few(lights) => return Some(lights.bindings.clone()),
            DirectLight::Pixels(view) | DirectLight::Samples(view) => view,
        };
        self.direct_layout.as_ref().map(|layout| {
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("direct irradiance"),
                layout,
                entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(view) }],
            })
        })
    }

    /// Returns the pipeline of a variant. Creates it unless it is cached.
    fn pipeline(&mut self, gpu: &Gpu, key: PipelineKey) -> wgpu::RenderPipeline {
        if let Some(kept) = self.pipelines.get(&key) {
            return kept.clone();
        }
        let (variant, kinds) = key;
        let mut constants: Vec<_> = kinds.iter().flat_map(LightKinds::constants).collect();
        if self.source == DirectSource::Few {
            constants.push(("ONE_SAMPLE", f64::from(u8::from(self.samples == 1))));
        }
        constants.push(("LIT_BY_LIGHTS", f64::from(u8::from(self.source != DirectSource::Stored))));
        let module = self.tiled_module.as_ref().filter(|_| variant.is_tiled).unwrap_or(&self.module);
        let pipeline = variant.pipeline(gpu, &self.layout, module, self.samples, constants);
        self.pipelines.insert(key, pipeline.clone());
        pipeline
    }
}
