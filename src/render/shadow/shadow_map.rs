//! Shadow map pass: what the light sees is lit (Williams 1978).
//!
//! What a map shows is in `map_projection`, how texels are written and read in `map_pipelines`.

use glam::Mat4;
use wgpu::util::DeviceExt;

use super::light_samples::LightSample;
use super::map_cache::Shown;
use super::map_pipelines::{face_layout, pipeline, read_layout};
use super::map_projection::MapProjection;
use super::real_time::Subject;
use super::solid::bind_mesh;
use crate::gpu::material_buffers::material_layout;
use crate::gpu::{Gpu, shaders};
use crate::scene::AlphaMode;

/// How shadow maps are drawn and read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapSettings {
    /// Texels across and down a map or a face.
    pub resolution: u32,
    /// Texels each way over which the edge of a shadow is softened.
    pub pcf_radius: u32,
    /// Shift of a point along its normal, texels: too little makes acne, too much lets light through thin walls.
    pub normal_offset: f32,
    /// Shift of a point towards the light, as deep as its surface falls over so many texels: too little makes acne, too
    /// much detaches shadows.
    pub slope_bias: f32,
}

impl Default for MapSettings {
    fn default() -> Self {
        Self { resolution: 2048, pcf_radius: 1, normal_offset: 0.4, slope_bias: 0.7 }
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
}

impl ShadowMapPass {
    /// Pipelines and sampler.
    pub fn new(gpu: &Gpu) -> Self {
        let module = shaders::SHADOW_MAP.module(&gpu.device);
        let face_layout = face_layout(gpu);
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shadow map"),
            bind_group_layouts: &[None, Some(&face_layout), Some(&material_layout(gpu))],
            immediate_size: 0,
        });
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("shadow map"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            compare: Some(wgpu::CompareFunction::GreaterEqual),
            ..Default::default()
        });
        Self {
            opaque: pipeline(gpu, &layout, &module, None),
            mask: pipeline(gpu, &layout, &module, Some(1.0)),
            blend: pipeline(gpu, &layout, &module, Some(2.0)),
            read_layout: read_layout(gpu),
            face_layout,
            sampler,
        }
    }

    /// Layout of bind group 2 of the pass that reads the map.
    pub fn read_layout(&self) -> &wgpu::BindGroupLayout {
        &self.read_layout
    }

    /// Draws the map of a light sample, unless it is kept, and binds it for the pass that reads it; the number of its faces,
    /// and the binding.
    pub fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        subject: Subject<'_>,
        sample: &LightSample,
        settings: &MapSettings,
    ) -> (u32, wgpu::BindGroup) {
        let projection = MapProjection::new(subject.shadows.scene(), sample, settings);
        let shown = Shown::new(subject.scene, &projection.projection_from_world, settings.resolution);
        let mut kept = subject.shadows.maps();
        let (map, is_new) = kept.map(gpu, shown);
        if is_new {
            for (projection_from_world, face) in projection.projection_from_world.iter().zip(&map.faces) {
                self.draw_face(gpu, encoder, subject, projection_from_world, face);
            }
        }
        let uniform = uniform_buffer(gpu, bytemuck::bytes_of(&projection.uniform));
        let bindings = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("shadow map"),
            layout: &self.read_layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(&map.all) },
                wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Sampler(&self.sampler) },
            ],
        });
        (projection.projection_from_world.len() as u32, bindings)
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

fn uniform_buffer(gpu: &Gpu, contents: &[u8]) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::UNIFORM;
    gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some("shadow map"), contents, usage })
}
