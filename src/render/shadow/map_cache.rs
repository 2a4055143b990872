//! Shadow maps that are kept from picture to picture: while neither the light nor the casters move, a map stays true.
//! All renderers of a scene share them.

use glam::Mat4;

use super::map_pipelines::DEPTH_FORMAT;
use crate::gpu::{Gpu, SceneBuffers};

/// Texels that are kept at most: 256 MiB, sixteen faces of the usual size.
const MAX_TEXELS: usize = 1 << 26;

/// A map on the device.
pub struct Map {
    shown: Shown,
    /// One view a face, to draw to.
    pub faces: Vec<wgpu::TextureView>,
    /// All faces, to read.
    pub all: wgpu::TextureView,
}

/// What a map shows: the triangles of which buffers, from where, and how finely.
#[derive(Clone, PartialEq)]
pub struct Shown {
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    projection_from_world: Vec<Mat4>,
    resolution: u32,
}

impl Shown {
    /// The casters of a scene by the projections of all faces, each `resolution` texels wide.
    pub fn new(scene: &SceneBuffers, projection_from_world: &[Mat4], resolution: u32) -> Self {
        Self {
            vertices: scene.vertices.clone(),
            indices: scene.indices.clone(),
            projection_from_world: projection_from_world.to_vec(),
            resolution,
        }
    }

    fn num_texels(&self) -> usize {
        self.projection_from_world.len() * (self.resolution as usize).pow(2)
    }
}

/// Maps in the order in which they were asked for last.
#[derive(Default)]
pub struct MapCache {
    maps: Vec<Map>,
}

impl MapCache {
    /// The map that shows this, and whether it has still to be drawn.
    ///
    /// Where there is no room left, the map that was asked for last makes room: lights take turns, and the others will be
    /// asked for before it.
    pub fn map(&mut self, gpu: &Gpu, shown: Shown) -> (&Map, bool) {
        let found = self.maps.iter().position(|map| map.shown == shown);
        let map = match found {
            Some(at) => self.maps.remove(at),
            None => {
                let mut kept: usize = self.maps.iter().map(|map| map.shown.num_texels()).sum();
                while kept + shown.num_texels() > MAX_TEXELS
                    && let Some(last) = self.maps.pop()
                {
                    kept -= last.shown.num_texels();
                }
                Map::new(gpu, shown)
            }
        };
        self.maps.push(map);
        (&self.maps[self.maps.len() - 1], found.is_none())
    }
}

impl Map {
    fn new(gpu: &Gpu, shown: Shown) -> Self {
        let num_faces = shown.projection_from_world.len() as u32;
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("shadow map"),
            size: wgpu::Extent3d {
                width: shown.resolution,
                height: shown.resolution,
                depth_or_array_layers: num_faces,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: DEPTH_FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let view = |dimension, first, count| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(dimension),
                base_array_layer: first,
                array_layer_count: Some(count),
                ..Default::default()
            })
        };
        let faces = (0..num_faces).map(|face| view(wgpu::TextureViewDimension::D2, face, 1)).collect();
        let all = view(wgpu::TextureViewDimension::D2Array, 0, num_faces);
        Self { shown, faces, all }
    }
}
