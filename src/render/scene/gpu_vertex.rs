//! Layout of a vertex in the vertex buffer.

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};

use crate::scene::Vertex;

/// A vertex in the vertex buffer.
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
