//! Shadow maps that are kept from picture to picture: while neither the light nor the casters move, a map stays true.
//! All renderers of a scene share them.

use std::time::{Duration, Instant};

use glam::Mat4;

use super::map_overview::num_blocks;
use super::map_pipelines::{DEPTH_FORMAT, OVERVIEW_FORMAT};
use crate::gpu::Gpu;
use crate::render::scene::SceneBuffers;

/// Texels that are kept at most: 256 MiB, sixteen faces of the usual size, and a sixteenth of it for their overviews.
const MAX_TEXELS: usize = 1 << 26;

/// Maps that nobody has asked for this long are let go.
const LONGEST_UNUSED: Duration = Duration::from_secs(5);

/// A map on the device.
pub struct Map {
    shown: Shown,
    asked_for: Instant,
    /// One view a face, to draw to.
    pub faces: Vec<wgpu::TextureView>,
    /// The same of the overview.
    pub overview_faces: Vec<wgpu::TextureView>,
    /// All faces, to read.
    pub textures: MapTextures,
}

/// All faces of a map, to read.
#[derive(Clone)]
pub struct MapTextures {
    /// Depth of each texel.
    pub depth: wgpu::TextureView,
    /// Plane that each block of texels shows.
    pub overview: wgpu::TextureView,
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
        self.maps.push(Map { asked_for: Instant::now(), ..map });
        (&self.maps[self.maps.len() - 1], found.is_none())
    }
}

impl MapCache {
    /// Lets go of maps that were not asked for of late: shadows are found otherwise by now.
    pub fn forget_unused(&mut self) {
        self.maps.retain(|map| map.asked_for.elapsed() < LONGEST_UNUSED);
    }
}

impl Map {
    fn new(gpu: &Gpu, shown: Shown) -> Self {
        let num_faces = shown.projection_from_world.len() as u32;
        let depth = texture(gpu, DEPTH_FORMAT, shown.resolution, num_faces);
        let overview = texture(gpu, OVERVIEW_FORMAT, num_blocks(shown.resolution), num_faces);
        let textures = MapTextures { depth: all_faces(&depth), overview: all_faces(&overview) };
        Self {
            shown,
            asked_for: Instant::now(),
            faces: each_face(&depth),
            overview_faces: each_face(&overview),
            textures,
        }
    }
}

impl MapTextures {
    /// Stand where a map is bound and not read.
    pub fn none(gpu: &Gpu) -> Self {
        let [depth, overview] = [DEPTH_FORMAT, OVERVIEW_FORMAT].map(|format| all_faces(&texture(gpu, format, 1, 1)));
        Self { depth, overview }
    }
}

fn texture(gpu: &Gpu, format: wgpu::TextureFormat, width: u32, num_faces: u32) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("shadow map"),
        size: wgpu::Extent3d { width, height: width, depth_or_array_layers: num_faces },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    })
}

fn all_faces(texture: &wgpu::Texture) -> wgpu::TextureView {
    let dimension = Some(wgpu::TextureViewDimension::D2Array);
    texture.create_view(&wgpu::TextureViewDescriptor { dimension, ..Default::default() })
}

fn each_face(texture: &wgpu::Texture) -> Vec<wgpu::TextureView> {
    let face = |face| {
        texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2),
            base_array_layer: face,
            array_layer_count: Some(1),
            ..Default::default()
        })
    };
    (0..texture.depth_or_array_layers()).map(face).collect()
}
