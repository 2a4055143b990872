//! A lit scene on the device: triangles in batches of one material, and the light of their vertices.
//!
//! Positions, textures and materials are uploaded once. Only the light is written again: while a bake runs, or when the
//! scene is solved again with a dimmed lamp.

use std::sync::PoisonError;

use wgpu::util::DeviceExt;

use super::draw_batch::{Chunk, DrawBatch};
use super::draw_order::{DrawOrder, draw_order, index_buffer};
use super::gpu_vertex::GpuVertex;
use super::materials::material_bind_groups;
use super::pre_exposure::pre_exposure;
use super::tiled_mesh::TiledMesh;
use super::tiles::Tiles;
use super::vertex_light::{LightBuffer, LightVersion};
use super::vertex_order::VertexOrder;
use crate::baked::coarse::CoarseMesh;
use crate::baked::{BakedScene, VertexLight};
use crate::gpu::Gpu;
use crate::scene::Scene;

/// A lit scene on the device.
pub struct SceneBuffers {
    /// [`GpuVertex`] of each vertex, in the order in which triangles use them.
    pub vertices: wgpu::Buffer,
    /// Three u32 a triangle, ordered by batch.
    pub indices: wgpu::Buffer,
    /// Bind groups of the materials `[m]`.
    pub materials: Vec<wgpu::BindGroup>,
    /// Triangles by material; those that blend come last.
    pub batches: Vec<DrawBatch>,
    /// The coarse mesh, with the same surfaces in fewer triangles, if the scene is a bake.
    pub tiled: Option<TiledMesh>,
    /// Power of two that brings the scene's radiance into the range of half floats.
    pub pre_exposure: f32,
    pub(super) chunks: Vec<Chunk>,
    pub(super) vertex_order: VertexOrder,
    pub(super) light: LightBuffer,
}

impl SceneBuffers {
    /// Uploads triangles, materials, textures (with mip maps) and light.
    #[must_use]
    pub fn new(gpu: &Gpu, baked: &BakedScene) -> Self {
        let scene = &baked.scene;
        let num_groups = scene.light_groups.len().max(baked.light.groups.len());
        let limits = gpu.device.limits();
        let coarse = || CoarseMesh::new(scene, baked.trees.as_ref(), limits.max_texture_dimension_2d);
        let (order, coarse) = rayon::join(|| draw_order(scene, |_| true), coarse);
        let coarse = coarse.filter(|coarse| Tiles::can_be_bound(coarse, &limits));
        let (DrawOrder { batches, chunks, .. }, indices) = order;
        let vertex_order = VertexOrder::new(&indices, scene.vertices.len());
        let buffers = Self {
            vertices: vertex_buffer(gpu, scene, &vertex_order),
            indices: index_buffer(gpu, &vertex_order.indices(&indices)),
            tiled: coarse.map(|coarse| TiledMesh::new(gpu, scene, &vertex_order, coarse)),
            vertex_order,
            materials: material_bind_groups(gpu, scene),
            batches,
            chunks,
            pre_exposure: pre_exposure(baked),
            light: LightBuffer::new(gpu, num_groups, scene.vertices.len()),
        };
        buffers.set_light(gpu, &baked.light);
        buffers
    }

    /// Returns the number of light groups.
    #[must_use]
    pub fn num_groups(&self) -> usize {
        self.light.num_groups
    }

    /// Returns the number of vertices of the mesh.
    #[must_use]
    pub fn num_vertices(&self) -> usize {
        self.light.num_vertices
    }

    /// Returns the irradiance: three f32 for `[2 x group + (0 direct, 1 indirect)][vertex]`, vertices in the order of
    /// [`Self::vertices`].
    #[must_use]
    pub fn irradiance(&self) -> &wgpu::Buffer {
        &self.light.irradiance
    }

    /// Returns the version of the light, which changes with each write.
    #[must_use]
    pub fn light_version(&self) -> LightVersion {
        self.light.version()
    }

    /// Replaces the light. The mesh is unchanged, and groups that `light` lacks keep their light.
    pub fn set_light(&self, gpu: &Gpu, light: &VertexLight) {
        self.light.write(gpu, &self.vertex_order, light, |_| ());
    }

    /// Replaces the light as [`Self::set_light`], but submits it part by part and calls `rest` after each part. So a
    /// frame of another thread waits for one part at most.
    pub fn set_light_in_parts(&self, gpu: &Gpu, light: &VertexLight, rest: impl Fn()) {
        self.light.write(gpu, &self.vertex_order, light, |gpu| {
            gpu.queue.submit([]);
            rest();
        });
    }

    /// Forces the next picture to fill the tiles of the coarse mesh again, as after a change of the shader that fills
    /// them.
    pub fn forget_tiles(&self) {
        if let Some(tiled) = &self.tiled {
            *tiled.tiles.held.lock().unwrap_or_else(PoisonError::into_inner) = None;
        }
    }

    /// Returns indices and batches of the coarse mesh if there is one, else those of the elements.
    #[must_use]
    pub fn coarsest(&self) -> (&wgpu::Buffer, &[DrawBatch]) {
        match &self.tiled {
            Some(tiled) => (&tiled.indices, &tiled.batches),
            None => (&self.indices, &self.batches),
        }
    }

    /// Returns the vertices that a batch indexes.
    #[must_use]
    pub fn vertices_of(&self, batch: &DrawBatch) -> &wgpu::Buffer {
        let tiled = self.tiled.as_ref().filter(|_| batch.is_tiled);
        tiled.map_or(&self.vertices, |tiled| &tiled.vertices)
    }
}

fn vertex_buffer(gpu: &Gpu, scene: &Scene, order: &VertexOrder) -> wgpu::Buffer {
    let vertices: Vec<GpuVertex> = scene.vertices.iter().map(GpuVertex::from).collect();
    gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("scene vertices"),
        contents: bytemuck::cast_slice(&order.sorted(&vertices)),
        usage: wgpu::BufferUsages::VERTEX,
    })
}
