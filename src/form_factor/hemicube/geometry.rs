//! The scene on the device as item buffers draw it: input triangles in chunks, bisection trees, cut-outs.

use std::collections::HashMap;

use bytemuck::{Pod, Zeroable};
use glam::Vec2;
use wgpu::util::DeviceExt;

use super::culling::Culling;
use crate::base::ids::{MaterialId, TriangleId};
use crate::gpu::Gpu;
use crate::patch::{Node, PatchMesh};
use crate::scene::chunks::spatial_order;
use crate::scene::{AlphaMode, Scene, Wrap};

/// Buffers of one scene.
pub(super) struct Geometry {
    pub vertices: wgpu::Buffer,
    pub triangles: wgpu::Buffer,
    pub tree: wgpu::Buffer,
    pub cutouts: wgpu::Buffer,
    pub alphas: wgpu::Buffer,
    pub has_cutouts: bool,
    /// Selects the triangles that each face draws; `None` draws everything.
    pub culling: Option<Culling>,
    pub num_vertices: u32,
}

impl Geometry {
    pub(super) fn new(gpu: &Gpu, scene: &Scene, mesh: &PatchMesh) -> Self {
        let order = spatial_order(|t| scene.corners(t), (0..scene.triangles.len()).map(TriangleId::new));
        let vertices: Vec<gpu_data::Vertex> = order.iter().flat_map(|&t| vertices_of(scene, mesh, t)).collect();
        let mut cutouts = Cutouts::default();
        let triangles: Vec<gpu_data::Triangle> = order.iter().map(|&t| cutouts.describe_triangle(scene, t)).collect();
        let has_cutouts = !cutouts.records.is_empty();
        cutouts.records.push(gpu_data::Cutout::zeroed());
        cutouts.alphas.resize((cutouts.alphas.len() + 1).next_multiple_of(4), 0);
        let buffer_for = |usage, label, contents: &[u8]| {
            gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
        };
        let buffer = |label, contents: &[u8]| buffer_for(wgpu::BufferUsages::STORAGE, label, contents);
        Self {
            vertices: buffer_for(wgpu::BufferUsages::VERTEX, "hemicube vertices", bytemuck::cast_slice(&vertices)),
            triangles: buffer("hemicube triangles", bytemuck::cast_slice(&triangles)),
            // wgpu allows no empty binding, hence one node more.
            tree: buffer("hemicube trees", bytemuck::cast_slice(&[mesh.tree.as_slice(), &[Node::default()]].concat())),
            cutouts: buffer("hemicube cut-outs", bytemuck::cast_slice(&cutouts.records)),
            alphas: buffer("hemicube alphas", &cutouts.alphas),
            has_cutouts,
            culling: Some(Culling::new(scene, &order)),
            num_vertices: vertices.len() as u32,
        }
    }
}

/// The corners of a triangle, with the ids from which a fragment derives its element.
fn vertices_of(scene: &Scene, mesh: &PatchMesh, id: TriangleId) -> [gpu_data::Vertex; 3] {
    let root = mesh.roots[id.index()];
    let back_offset = if root.has_backs { root.num_elements } else { 0 };
    scene.corners(id).map(|p| gpu_data::Vertex { position: p.to_array(), root: root.node.bits(), back_offset })
}

/// Memory layout of [`Geometry::vertices`].
pub(super) const VERTEX_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<gpu_data::Vertex>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Uint32x2],
};

/// Alpha channels of the materials that let light through, gathered while triangles are described.
#[derive(Default)]
struct Cutouts {
    records: Vec<gpu_data::Cutout>,
    alphas: Vec<u8>,
    index_of: HashMap<MaterialId, u32>,
}

impl Cutouts {
    fn describe_triangle(&mut self, scene: &Scene, id: TriangleId) -> gpu_data::Triangle {
        let triangle = &scene.triangles[id.index()];
        let material = scene.material_of(id);
        let cutout = match material.alpha_mode {
            AlphaMode::Opaque => 0,
            AlphaMode::Mask { .. } | AlphaMode::Blend => self.index_of(scene, triangle.material) + 1,
        };
        let vertices = triangle.vertices.map(|v| &scene.vertices[v as usize]);
        let slot = material.base_colour_texture;
        let uv = vertices.map(|v| slot.map_or(Vec2::ZERO, |slot| slot.coordinate(v.uv)).to_array());
        let alpha_byte = |i: usize| ((vertices[i].colour.w * 255.0).round() as u32).min(255) << (8 * i);
        gpu_data::Triangle { cutout, vertex_alpha: alpha_byte(0) | alpha_byte(1) | alpha_byte(2), uv }
    }

    fn index_of(&mut self, scene: &Scene, id: MaterialId) -> u32 {
        if let Some(&index) = self.index_of.get(&id) {
            return index;
        }
        let material = &scene.materials[id.index()];
        let first_texel = self.alphas.len() as u32;
        let (size, wrap) = match &material.base_colour_texture {
            Some(slot) => {
                let texture = &scene.textures[slot.texture.index()];
                self.alphas.extend(texture.image.rgba.iter().skip(3).step_by(4));
                let wrap = wrap_code(texture.sampler.wrap_u) | wrap_code(texture.sampler.wrap_v) << 16;
                ([texture.image.width, texture.image.height], wrap)
            }
            None => {
                self.alphas.push(255);
                ([1, 1], 0)
            }
        };
        let cutoff = match material.alpha_mode {
            AlphaMode::Mask { cutoff } => cutoff,
            AlphaMode::Opaque | AlphaMode::Blend => -1.0,
        };
        let index = self.records.len() as u32;
        let alpha_factor = material.base_colour.w;
        self.records.push(gpu_data::Cutout { first_texel, padding: 0, size, wrap, alpha_factor, cutoff, padding_2: 0 });
        self.index_of.insert(id, index);
        index
    }
}

fn wrap_code(wrap: Wrap) -> u32 {
    match wrap {
        Wrap::Repeat => 0,
        Wrap::Mirror => 1,
        Wrap::Clamp => 2,
    }
}

/// Keep in sync with `shaders/item_buffer.wgsl`.
mod gpu_data {
    use super::{Pod, Zeroable};

    #[repr(C)]
    #[derive(Clone, Copy, Pod, Zeroable)]
    pub struct Vertex {
        pub position: [f32; 3],
        pub root: u32,
        pub back_offset: u32,
    }

    #[repr(C)]
    #[derive(Clone, Copy, Pod, Zeroable)]
    pub struct Triangle {
        pub cutout: u32,
        pub vertex_alpha: u32,
        pub uv: [[f32; 2]; 3],
    }

    #[repr(C)]
    #[derive(Clone, Copy, Pod, Zeroable)]
    pub struct Cutout {
        pub first_texel: u32,
        pub padding: u32,
        pub size: [u32; 2],
        pub wrap: u32,
        pub alpha_factor: f32,
        pub cutoff: f32,
        pub padding_2: u32,
    }
}
