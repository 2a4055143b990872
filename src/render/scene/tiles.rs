//! The light of a coarse mesh on the device: a texture of tiles, and the buffers from which
//! `render::stored_light::light_tiles` fills it.

use std::sync::Mutex;

use bytemuck::{Pod, Zeroable};
use glam::{UVec2, Vec3};
use wgpu::util::DeviceExt;

use super::vertex_light::LightVersion;
use super::vertex_order::VertexOrder;
use crate::baked::coarse::CoarseMesh;
use crate::gpu::Gpu;
use crate::render::targets::HDR_FORMAT;

/// The light of tiles, and the buffers from which it is filled.
pub struct Tiles {
    /// Radiance of white paint, scaled by pre-exposure.
    pub light: wgpu::TextureView,
    /// `Element` of shaders/stored_light/light_tiles.wgsl for each element in a tile.
    pub elements: wgpu::Buffer,
    /// Index of the element of each texel, a u32, row by row.
    pub element_of: wgpu::Buffer,
    /// Texels beyond the long sides of tiles, a u32 each. Bilinear reads touch them.
    pub beyond: wgpu::Buffer,
    /// Scratch for the radiance at the vertices of the scene, eight bytes each.
    pub radiances: wgpu::Buffer,
    /// Width and height of the texture, texels.
    pub side: u32,
    /// The light in the texture; `None` before it is filled.
    pub held: Mutex<Option<HeldLight>>,
}

/// A version of the light of the vertices, and the weights that it was summed with.
#[derive(Clone, Debug, PartialEq)]
pub struct HeldLight {
    /// The light.
    pub light: LightVersion,
    /// All weights.
    pub weights: Vec<Vec3>,
}

/// `Element` of shaders/stored_light/light_tiles.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct TileElement {
    vertices: [u32; 3],
    corners: [u32; 3],
}

/// Packs a texel as shaders/stored_light/light_tiles.wgsl reads it: x in the lower half, y in the upper half.
fn packed(texel: UVec2) -> u32 {
    texel.x | texel.y << 16
}

impl Tiles {
    /// Returns true if a device with these limits can bind the buffers.
    pub(super) fn can_be_bound(coarse: &CoarseMesh, limits: &wgpu::Limits) -> bool {
        let sizes = [size_of_val(&coarse.element_of[..]), size_of::<TileElement>() * coarse.elements.len()];
        sizes.into_iter().all(|size| size as u64 <= limits.max_storage_buffer_binding_size)
    }

    /// Uploads everything except the light.
    pub(super) fn new(gpu: &Gpu, coarse: &CoarseMesh, order: &VertexOrder, num_vertices: usize) -> Self {
        let element = |vertices: [u32; 3], corners: [UVec2; 3]| TileElement {
            vertices: vertices.map(|v| order.place(v)),
            corners: corners.map(packed),
        };
        let elements: Vec<TileElement> = coarse.elements.iter().map(|e| element(e.vertices, e.corners)).collect();
        let beyond: Vec<u32> = coarse.beyond.iter().copied().map(packed).collect();
        let buffer = |label, contents: &[u8]| {
            let usage = wgpu::BufferUsages::STORAGE;
            gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
        };
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("light of tiles"),
            size: wgpu::Extent3d { width: coarse.side, height: coarse.side, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: HDR_FORMAT,
            usage: wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        Self {
            light: texture.create_view(&Default::default()),
            elements: buffer("elements in tiles", bytemuck::cast_slice(&elements)),
            element_of: buffer("elements of texels", bytemuck::cast_slice(&coarse.element_of)),
            beyond: buffer("texels beyond tiles", bytemuck::cast_slice(&beyond)),
            radiances: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("radiance at vertices"),
                size: 8 * num_vertices as u64,
                usage: wgpu::BufferUsages::STORAGE,
                mapped_at_creation: false,
            }),
            side: coarse.side,
            held: Mutex::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::baked::coarse::tiles::NOTHING;
    use crate::gpu::shader::{constant, struct_layout};
    use crate::render::stored_light::light_tiles::LIGHT_TILES;

    #[test]
    fn tiles_need_buffers_that_the_device_can_bind() {
        let coarse = |num_texels| CoarseMesh {
            triangles: Vec::new(),
            tiles: Vec::new(),
            side: 0,
            elements: Vec::new(),
            element_of: vec![NOTHING; num_texels],
            beyond: Vec::new(),
        };
        let limits = wgpu::Limits { max_storage_buffer_binding_size: 400, ..wgpu::Limits::default() };
        assert_eq!([100, 101].map(|num_texels| Tiles::can_be_bound(&coarse(num_texels), &limits)), [true, false]);
    }

    #[test]
    fn the_layout_of_elements_is_that_of_the_shader() {
        let written = [std::mem::offset_of!(TileElement, vertices), std::mem::offset_of!(TileElement, corners)];
        assert_eq!(struct_layout(&LIGHT_TILES, "Element"), [written[0], written[1], size_of::<TileElement>()]);
        assert_eq!(constant(&LIGHT_TILES, "NOTHING"), NOTHING);
    }
}
