//! A lit scene on the device: triangles in batches of one material, and the light of their vertices.
//!
//! Positions, textures and materials stay as they are uploaded; only the light is written again, while a bake runs or
//! when a lamp is dimmed by solving anew.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};
use wgpu::util::DeviceExt;

use super::materials::material_bind_groups;
use super::order::{Order, index_buffer, order};
use super::tiled_mesh::TiledMesh;
use super::tiles::Tiles;
use super::vertex_light::LightBuffer;
use super::vertex_order::VertexOrder;
use super::view::Chunk;
use crate::baked::coarse::CoarseMesh;
use crate::baked::{BakedScene, VertexLight};
use crate::base::ids::MaterialId;
use crate::gpu::Gpu;
use crate::scene::{AlphaMode, Scene, Vertex};

/// Half floats, of which HDR textures are made, hold this and four times as much.
const COMFORTABLE_RADIANCE: f32 = 16_384.0;
/// Typical radiance of surfaces that leaves half floats room for light a thousand times as strong or as weak.
const COMFORTABLE_SURFACES: std::ops::RangeInclusive<f32> = 1.0 / 1024.0..=64.0;

/// A lit scene on the device.
pub struct SceneBuffers {
    /// [`GpuVertex`] of each vertex, in the order in which triangles use them.
    pub vertices: wgpu::Buffer,
    /// Three u32 a triangle, batch by batch.
    pub indices: wgpu::Buffer,
    /// Bind groups of the materials `[m]`.
    pub materials: Vec<wgpu::BindGroup>,
    /// Triangles by material, those that blend last.
    pub batches: Vec<Batch>,
    /// The same surfaces in fewer triangles, where the scene is a bake.
    pub tiled: Option<TiledMesh>,
    /// Power of two that brings the scene's radiance into the range of half floats.
    pub pre_exposure: f32,
    pub(super) chunks: Vec<Chunk>,
    pub(super) vertex_order: VertexOrder,
    pub(super) light: LightBuffer,
    pub(super) num_groups: usize,
    pub(super) num_vertices: usize,
}

/// Triangles that are drawn in one call.
#[derive(Clone, Debug, PartialEq)]
pub struct Batch {
    /// Their part of the index buffer.
    pub indices: Range<u32>,
    /// Their material.
    pub material: MaterialId,
    /// How its alpha acts.
    pub alpha_mode: AlphaMode,
    /// Which faces exist.
    pub faces: Faces,
    /// Its material has textures.
    pub has_textures: bool,
    /// Its material shows its base colour as it is, without light.
    pub is_unlit: bool,
    /// Its light is in tiles, not at its vertices.
    pub is_tiled: bool,
}

/// Which faces of a batch's triangles are surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Faces {
    /// The front; the back is solid but black.
    Front,
    /// The front, and another triangle in the same place is the back: a double-sided surface in a bake.
    FrontOfTwins,
    /// Both faces of one triangle: a double-sided surface that was not baked.
    Both,
}

impl Faces {
    /// Nothing is seen from behind, where single-sided surfaces are not if `cull_back` says so.
    #[must_use]
    pub fn are_culled(self, cull_back: bool) -> bool {
        match self {
            Faces::Front => cull_back,
            Faces::FrontOfTwins => true,
            Faces::Both => false,
        }
    }
}

/// A vertex as the vertex buffer holds it.
#[repr(C)]
#[derive(Clone, Copy, Default, Pod, Zeroable)]
pub struct GpuVertex {
    position: Vec3,
    normal: Vec3,
    uv: [Vec2; 2],
    colour: [f32; 4],
}

impl GpuVertex {
    /// Attributes of the vertex buffer: 0 position, 1 normal, 2 both coordinate sets, 3 colour.
    pub const LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
        array_stride: size_of::<GpuVertex>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x4, 3 => Float32x4],
    };
}

impl From<&Vertex> for GpuVertex {
    fn from(vertex: &Vertex) -> Self {
        let Vertex { position, normal, uv, colour } = *vertex;
        Self { position, normal, uv, colour: colour.to_array() }
    }
}

impl SceneBuffers {
    /// Uploads triangles, materials, textures (with mip maps) and light.
    #[must_use]
    pub fn new(gpu: &Gpu, baked: &BakedScene) -> Self {
        let scene = &baked.scene;
        let num_groups = scene.light_groups.len().max(baked.light.groups.len());
        let limits = gpu.device.limits();
        let coarse = || CoarseMesh::new(scene, limits.max_texture_dimension_2d);
        let (order, coarse) = rayon::join(|| order(scene, |_| true), coarse);
        let coarse = coarse.filter(|coarse| Tiles::can_be_bound(coarse, &limits));
        let (Order { batches, chunks, .. }, indices) = order;
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
            num_groups,
            num_vertices: scene.vertices.len(),
        };
        buffers.set_light(gpu, &baked.light);
        buffers
    }

    /// How many light groups the light has.
    #[must_use]
    pub fn num_groups(&self) -> usize {
        self.num_groups
    }

    /// How many vertices the mesh has.
    #[must_use]
    pub fn num_vertices(&self) -> usize {
        self.num_vertices
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

/// A scale that brings the brightest lamp below [`COMFORTABLE_RADIANCE`], but keeps lit surfaces within
/// [`COMFORTABLE_SURFACES`]; 1 where both are so already.
fn pre_exposure(baked: &BakedScene) -> f32 {
    let lamps = baked.scene.materials.iter().map(|material| material.emission.max_element());
    let for_lamps = (COMFORTABLE_RADIANCE / lamps.fold(0.0, f32::max)).min(1.0);
    let typical = typical_white_radiance(&baked.light);
    let (low, high) = (COMFORTABLE_SURFACES.start() / typical, COMFORTABLE_SURFACES.end() / typical);
    let scale = if typical.is_normal() { for_lamps.clamp(low, high) } else { for_lamps };
    scale.log2().floor().exp2()
}

/// Log-average of the radiance that white paint shows in one part of the light: a vertex that touches a point light is
/// boundless, and must not count for more than another.
fn typical_white_radiance(light: &VertexLight) -> f32 {
    let values = light.groups.iter().flat_map(|group| group.direct.iter().chain(&group.indirect));
    let radiances = values.map(|value| value.max_element() / std::f32::consts::PI);
    let (mut log_sum, mut count) = (0.0, 0u32);
    for radiance in radiances.filter(|radiance| radiance.is_finite() && *radiance > 0.0) {
        log_sum += f64::from(radiance.log2());
        count += 1;
    }
    if count == 0 { 0.0 } else { (log_sum / f64::from(count)).exp2() as f32 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Material;

    #[test]
    fn only_very_bright_scenes_are_scaled_down_and_by_a_power_of_two() {
        let lamp = |nit| {
            let material = Material { emission: Vec3::splat(nit), ..Material::default() };
            BakedScene { scene: Scene { materials: vec![material], ..Scene::default() }, ..BakedScene::default() }
        };
        assert_eq!(pre_exposure(&lamp(0.0)), 1.0);
        assert_eq!(pre_exposure(&lamp(10_000.0)), 1.0);
        assert_eq!(pre_exposure(&lamp(1.6e9)), 2f32.powi(-17));
    }

    #[test]
    fn one_boundless_vertex_does_not_darken_the_scene() {
        let scale_of = |strongest: f32| {
            let mut light = VertexLight::dark(1, 1000);
            light.groups[0].direct.fill(Vec3::ONE);
            light.groups[0].direct[7] = Vec3::splat(strongest);
            pre_exposure(&BakedScene { light, ..BakedScene::default() })
        };
        assert_eq!(scale_of(f32::INFINITY), 1.0);
        assert_eq!(scale_of(f32::NAN), 1.0);
        assert_eq!(scale_of(1e9), 1.0);
    }
}
