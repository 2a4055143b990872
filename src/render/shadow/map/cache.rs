//! Cache of shadow maps: a map is valid while neither the light nor the casters move.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use glam::Mat4;

use super::bindings::{BLOCK_PLANES_FORMAT, DEPTH_FORMAT, num_blocks};
use crate::gpu::Gpu;
use crate::render::scene::SceneBuffers;
use crate::render::shadow::shared::scene::SceneData;

/// Largest number of cached texels: 256 MiB or sixteen faces of the default resolution, and a sixteenth of that for
/// block planes.
const MAX_TEXELS: usize = 1 << 26;

/// A map that no picture has used for this time is dropped.
const LONGEST_UNUSED: Duration = Duration::from_secs(5);

/// A map on the device.
pub struct Map {
    content: MapContent,
    last_used: Instant,
    /// A view of each face, to draw to.
    pub faces: Vec<wgpu::TextureView>,
    /// A view of the block planes of each face, to draw to.
    pub block_plane_faces: Vec<wgpu::TextureView>,
    /// All faces, to be read by shaders.
    pub textures: MapTextures,
}

/// All faces of a map, to be read by shaders.
#[derive(Clone)]
pub struct MapTextures {
    /// Depth of each texel.
    pub depth: wgpu::TextureView,
    /// Plane of each block of texels.
    pub block_planes: wgpu::TextureView,
}

/// Content of a map: triangles, projections and resolution. Maps with equal content are interchangeable.
#[derive(Clone, PartialEq)]
pub struct MapContent {
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    projection_from_world: Vec<Mat4>,
    resolution: u32,
}

impl MapContent {
    /// Returns the content for a scene, projected on to faces that are `resolution` texels wide.
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

/// The shadow maps of a scene, shared by all its renderers.
#[derive(Default)]
pub struct MapCache(Mutex<Maps>);

/// Maps in the order of their last use.
#[derive(Default)]
pub struct Maps {
    maps: Vec<Map>,
}

impl MapCache {
    /// Locks the maps and returns them.
    pub fn lock(&self) -> MutexGuard<'_, Maps> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl SceneData for MapCache {
    fn drop_unused(&self) {
        self.lock().maps.retain(|map| map.last_used.elapsed() < LONGEST_UNUSED);
    }
}

impl Maps {
    /// Returns the map with this content, and whether it has yet to be drawn.
    ///
    /// If there is no room, the most recently used map is dropped. Each picture uses the maps of all lights in the same
    /// order; therefore the next use of that map is the farthest in the future (Belady's rule for a cycle).
    pub fn get(&mut self, gpu: &Gpu, content: MapContent) -> (&Map, bool) {
        let found = self.maps.iter().position(|map| map.content == content);
        let map = match found {
            Some(at) => self.maps.remove(at),
            None => {
                let mut kept: usize = self.maps.iter().map(|map| map.content.num_texels()).sum();
                while kept + content.num_texels() > MAX_TEXELS
                    && let Some(last) = self.maps.pop()
                {
                    kept -= last.content.num_texels();
                }
                Map::new(gpu, content)
            }
        };
        self.maps.push(Map { last_used: Instant::now(), ..map });
        (&self.maps[self.maps.len() - 1], found.is_none())
    }
}

impl Map {
    fn new(gpu: &Gpu, content: MapContent) -> Self {
        let num_faces = content.projection_from_world.len() as u32;
        let depth = texture(gpu, DEPTH_FORMAT, content.resolution, num_faces);
        let block_planes = texture(gpu, BLOCK_PLANES_FORMAT, num_blocks(content.resolution), num_faces);
        let textures = MapTextures { depth: all_faces(&depth), block_planes: all_faces(&block_planes) };
        Self {
            content,
            last_used: Instant::now(),
            faces: each_face(&depth),
            block_plane_faces: each_face(&block_planes),
            textures,
        }
    }
}

impl MapTextures {
    /// Creates textures of one texel, for bindings that a shader declares and does not read.
    pub fn none(gpu: &Gpu) -> Self {
        let [depth, block_planes] =
            [DEPTH_FORMAT, BLOCK_PLANES_FORMAT].map(|format| all_faces(&texture(gpu, format, 1, 1)));
        Self { depth, block_planes }
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
