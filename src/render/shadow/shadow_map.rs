//! Shadow map pass: what the light sees is lit (Williams 1978).
//!
//! What a map shows is in `map_projection`, how texels are written and read in `map_pipelines`.

use glam::Mat4;

use super::light_samples::LightSample;
use super::map_cache::{MapTextures, Shown};
use super::map_overview::OverviewPass;
use super::map_pipelines::{face_layout, pipeline, read_layout, uniform_buffer};
use super::map_projection::{MapProjection, MapUniform};
use super::real_time::Subject;
use super::solid::bind_mesh;
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::scene::materials::material_layout;
use crate::scene::AlphaMode;

/// Depth as a light sees it.
pub(in crate::render) const SHADOW_MAP: Shader =
    shader!("shadow map", "shared/frame.wgsl", "shared/material.wgsl", "shadow_map.wgsl");

/// How shadow maps are drawn and read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapSettings {
    /// Texels across and down a map or a face.
    pub resolution: u32,
    /// Texels each way over which the edge of a shadow is softened.
    pub pcf_radius: u32,
    /// Shift of a point along its normal, texels: a cure of acne that lets light through thin walls, and that depths compared
    /// with the plane of the surface do without.
    pub normal_offset: f32,
    /// Shift of a point towards the light, as deep as its surface falls over so many texels: too little makes acne, too
    /// much detaches shadows.
    pub slope_bias: f32,
}

impl Default for MapSettings {
    fn default() -> Self {
        Self { resolution: 2048, pcf_radius: 1, normal_offset: 0.0, slope_bias: 0.3 }
    }
}

/// Shadow map pass.
pub struct ShadowMapPass {
    opaque: wgpu::RenderPipeline,
    mask: wgpu::RenderPipeline,
    blend: wgpu::RenderPipeline,
    face_layout: wgpu::BindGroupLayout,
    read_layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    overview: OverviewPass,
    no_map: MapTextures,
}

/// A map that has been drawn.
pub struct ReadableMap {
    /// One, or six of a cube.
    pub num_faces: u32,
    /// What the pass that reads it needs to know.
    pub uniform: MapUniform,
    /// All faces.
    pub textures: MapTextures,
}

impl ShadowMapPass {
    /// Pipelines and sampler.
    pub fn new(gpu: &Gpu) -> Self {
        let module = SHADOW_MAP.module(gpu);
        let face_layout = face_layout(gpu);
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shadow map"),
            bind_group_layouts: &[None, Some(&face_layout), Some(&material_layout(gpu))],
            immediate_size: 0,
        });
        let sampler =
            gpu.device.create_sampler(&wgpu::SamplerDescriptor { label: Some("shadow map"), ..Default::default() });
        Self {
            opaque: pipeline(gpu, &layout, &module, None),
            mask: pipeline(gpu, &layout, &module, Some(1.0)),
            blend: pipeline(gpu, &layout, &module, Some(2.0)),
            read_layout: read_layout(gpu),
            face_layout,
            sampler,
            overview: OverviewPass::new(gpu),
            no_map: MapTextures::none(gpu),
        }
    }

    /// Layout of bind group 2 of the pass that reads the map.
    pub fn read_layout(&self) -> &wgpu::BindGroupLayout {
        &self.read_layout
    }

    /// How texels are gathered.
    pub fn sampler(&self) -> &wgpu::Sampler {
        &self.sampler
    }

    /// Stands where a map is bound and not read.
    pub fn no_map(&self) -> &MapTextures {
        &self.no_map
    }

    /// The map of a light sample, drawn unless it is kept.
    pub fn map(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        subject: Subject<'_>,
        sample: &LightSample,
        settings: &MapSettings,
    ) -> ReadableMap {
        let projection = MapProjection::new(subject.shadows.bounds(), sample, settings);
        let shown = Shown::new(subject.scene, &projection.projection_from_world, settings.resolution);
        let mut kept = subject.shadows.maps();
        let (map, is_new) = kept.map(gpu, shown);
        if is_new {
            for (projection_from_world, face) in projection.projection_from_world.iter().zip(&map.faces) {
                self.draw_face(gpu, encoder, subject, projection_from_world, face);
            }
            self.overview.draw(gpu, encoder, map, &projection.uniform, &self.sampler);
        }
        let num_faces = projection.projection_from_world.len() as u32;
        ReadableMap { num_faces, uniform: projection.uniform, textures: map.textures.clone() }
    }

    /// A map, bound for the pass that reads it alone.
    pub fn bind(&self, gpu: &Gpu, map: &ReadableMap) -> wgpu::BindGroup {
        let uniform = uniform_buffer(gpu, bytemuck::bytes_of(&map.uniform));
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("shadow map"),
            layout: &self.read_layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(&map.textures.depth) },
                wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Sampler(&self.sampler) },
                wgpu::BindGroupEntry {
                    binding: 3,
                    resource: wgpu::BindingResource::TextureView(&map.textures.overview),
                },
            ],
        })
    }

    fn draw_face(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        subject: Subject<'_>,
        projection_from_world: &Mat4,
        face: &wgpu::TextureView,
    ) {
        let uniform = uniform_buffer(gpu, bytemuck::bytes_of(projection_from_world));
        let bindings = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("shadow map face"),
            layout: &self.face_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() }],
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow map"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: face,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Store }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_bind_group(1, &bindings, &[]);
        bind_mesh(&mut pass, subject.scene);
        for batch in &subject.scene.batches {
            pass.set_pipeline(match batch.alpha_mode {
                AlphaMode::Opaque => &self.opaque,
                AlphaMode::Mask { .. } => &self.mask,
                AlphaMode::Blend => &self.blend,
            });
            pass.set_bind_group(2, &subject.scene.materials[batch.material.index()], &[]);
            pass.draw_indexed(batch.indices.clone(), 0, 0..1);
        }
    }
}
