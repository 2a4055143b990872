//! Shadow map pass: draws the depth of the casters, seen from a light (Williams 1978).

use glam::Mat4;

use super::bindings::{caster_pipeline, face_layout, read_layout, uniform_buffer};
use super::block_planes::BlockPlanesPass;
use super::cache::{MapCache, MapContent, MapTextures};
use super::projection::{MapProjection, MapUniform};
use super::settings::MapSettings;
use crate::gpu::Gpu;
use crate::gpu::shader::{Shader, shader};
use crate::render::scene::materials::material_layout;
use crate::render::shadow::light::sample::LightSample;
use crate::render::shadow::shared::frame_context::FrameContext;
use crate::render::shadow::shared::pipeline::pipeline_layout;
use crate::render::shadow::shared::solid_surfaces::bind_mesh;
use crate::scene::AlphaMode;

const SHADOW_MAP: Shader =
    shader!("shadow map", "shared/frame.wgsl", "shared/material.wgsl", "shadow/map/shadow_map.wgsl");

/// Shadow map pass.
pub struct ShadowMapPass {
    opaque: wgpu::RenderPipeline,
    mask: wgpu::RenderPipeline,
    blend: wgpu::RenderPipeline,
    face_layout: wgpu::BindGroupLayout,
    read_layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    block_planes: BlockPlanesPass,
    no_map: MapTextures,
}

/// A map that has been drawn.
pub struct ReadableMap {
    /// Number of faces: one, or six of a cube.
    pub num_faces: u32,
    /// Projection of points into the map.
    pub uniform: MapUniform,
    /// Depth and block planes of all faces.
    pub textures: MapTextures,
}

impl ShadowMapPass {
    /// Creates pipelines and sampler.
    pub fn new(gpu: &Gpu) -> Self {
        let module = SHADOW_MAP.module(gpu);
        let face_layout = face_layout(gpu);
        let layout = pipeline_layout(gpu, "shadow map", &[None, Some(&face_layout), Some(&material_layout(gpu))]);
        let sampler =
            gpu.device.create_sampler(&wgpu::SamplerDescriptor { label: Some("shadow map"), ..Default::default() });
        Self {
            opaque: caster_pipeline(gpu, &layout, &module, None),
            mask: caster_pipeline(gpu, &layout, &module, Some(1.0)),
            blend: caster_pipeline(gpu, &layout, &module, Some(2.0)),
            read_layout: read_layout(gpu),
            face_layout,
            sampler,
            block_planes: BlockPlanesPass::new(gpu),
            no_map: MapTextures::none(gpu),
        }
    }

    /// Returns the layout of bind group 2 of passes that read one map.
    pub fn read_layout(&self) -> &wgpu::BindGroupLayout {
        &self.read_layout
    }

    /// Returns the sampler without filtering, for `textureGather`.
    pub fn sampler(&self) -> &wgpu::Sampler {
        &self.sampler
    }

    /// Returns textures for bindings that a shader declares and does not read.
    pub fn no_map(&self) -> &MapTextures {
        &self.no_map
    }

    /// Returns the map of a light sample. Draws it unless it is cached.
    pub fn map(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        frame: FrameContext<'_>,
        sample: &LightSample,
        settings: &MapSettings,
    ) -> ReadableMap {
        let projection = MapProjection::new(frame.shadows.bounds(), sample, settings);
        let content = MapContent::new(frame.scene, &projection.projection_from_world, settings.resolution);
        let cache = frame.shadows.kept(MapCache::default);
        let mut maps = cache.lock();
        let (map, is_new) = maps.get(frame.gpu, content);
        if is_new {
            for (projection_from_world, face) in projection.projection_from_world.iter().zip(&map.faces) {
                self.draw_face(encoder, frame, projection_from_world, face);
            }
            self.block_planes.draw(frame.gpu, encoder, map, &projection.uniform, &self.sampler);
        }
        let num_faces = projection.projection_from_world.len() as u32;
        ReadableMap { num_faces, uniform: projection.uniform, textures: map.textures.clone() }
    }

    /// Binds a map as bind group 2 of a pass that reads one map.
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
                    resource: wgpu::BindingResource::TextureView(&map.textures.block_planes),
                },
            ],
        })
    }

    fn draw_face(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        frame: FrameContext<'_>,
        projection_from_world: &Mat4,
        face: &wgpu::TextureView,
    ) {
        let uniform = uniform_buffer(frame.gpu, bytemuck::bytes_of(projection_from_world));
        let bindings = frame.gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
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
        bind_mesh(&mut pass, frame.scene);
        for batch in &frame.scene.batches {
            pass.set_pipeline(match batch.alpha_mode {
                AlphaMode::Opaque => &self.opaque,
                AlphaMode::Mask { .. } => &self.mask,
                AlphaMode::Blend => &self.blend,
            });
            pass.set_bind_group(2, &frame.scene.materials[batch.material.index()], &[]);
            pass.draw_indexed(batch.indices.clone(), 0, 0..1);
        }
    }
}
