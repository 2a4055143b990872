//! The coarse mesh of a bake on the device, and the part of it that a picture draws.
//!
//! The coarse mesh is designed to make software rendering (`viewer::software`) faster. Hardware draws it too, but there
//! the gain has not been measured.

use std::sync::Arc;

use glam::{Vec2, Vec3, Vec4};
use wgpu::util::DeviceExt;

use super::cull_view::CullView;
use super::draw_batch::{Chunk, DrawBatch};
use super::draw_order::{DrawOrder, MeshTriangles, index_buffer};
use super::gpu_vertex::GpuVertex;
use super::tiles::Tiles;
use super::vertex_order::VertexOrder;
use crate::baked::coarse::{CoarseMesh, Tile};
use crate::base::ids::TriangleId;
use crate::gpu::Gpu;
use crate::scene::{AlphaMode, Scene, Triangle, edge_cross};

/// The coarse mesh of a bake.
#[derive(Clone)]
pub struct TiledMesh {
    /// [`GpuVertex`] of the corners of triangles with tiles. The other triangles use the vertices of the scene.
    pub vertices: wgpu::Buffer,
    /// Two triples of f32 for each of these corners: its place in a tile. They use the attributes that otherwise hold
    /// irradiance.
    pub places: wgpu::Buffer,
    /// Three u32 a triangle, ordered by batch.
    pub indices: wgpu::Buffer,
    /// Triangles by material; those with tiles are in batches of their own.
    pub batches: Vec<DrawBatch>,
    /// Light of the tiles.
    pub tiles: Arc<Tiles>,
    /// All triangles in the order of drawing. Each picture selects from it.
    drawing: Arc<Drawing>,
    mesh: Arc<Mesh>,
}

/// Triangles in the order of drawing.
struct Drawing {
    chunks: Vec<Chunk>,
    /// Vertices of the triangles, as indices on the device.
    triangles: Vec<[u32; 3]>,
    /// Planes of the triangles, positive in front.
    planes: Vec<Vec4>,
}

/// The triangles of the mesh, those with tiles first.
struct Mesh {
    triangles: Vec<Triangle>,
    num_tiles: usize,
}

impl TiledMesh {
    /// Uploads the coarse mesh of a scene. `order` is the order of the scene's vertices on the device.
    pub(super) fn new(gpu: &Gpu, scene: &Scene, order: &VertexOrder, mut coarse: CoarseMesh) -> Self {
        sort_tiles(&mut coarse, scene);
        let tiled = &coarse.triangles[..coarse.tiles.len()];
        let corners = tiled.iter().flat_map(|triangle| triangle.vertices);
        let vertices: Vec<GpuVertex> = corners.map(|v| GpuVertex::from(&scene.vertices[v as usize])).collect();
        let places: Vec<[Vec3; 2]> =
            coarse.tiles.iter().flat_map(|tile| corners_of(tile, coarse.side as f32)).collect();
        let mesh = Mesh { num_tiles: coarse.tiles.len(), triangles: coarse.triangles.clone() };
        let (batches, drawing) = mesh.drawing(scene, order, |_| true);
        let buffer = |label, contents: &[u8], usage| {
            gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
        };
        Self {
            vertices: buffer("corners of tiles", bytemuck::cast_slice(&vertices), wgpu::BufferUsages::VERTEX),
            places: buffer("places of tiles", bytemuck::cast_slice(&places), wgpu::BufferUsages::VERTEX),
            indices: index_buffer(gpu, drawing.triangles.as_flattened()),
            batches,
            drawing: Arc::new(drawing),
            tiles: Arc::new(Tiles::new(gpu, &coarse, order, scene.vertices.len())),
            mesh: Arc::new(mesh),
        }
    }

    /// Returns the triangles for which `is_shown` returns true.
    pub(super) fn part(
        &self,
        gpu: &Gpu,
        scene: &Scene,
        order: &VertexOrder,
        is_shown: impl Fn(&Triangle) -> bool,
    ) -> Self {
        let (batches, drawing) = self.mesh.drawing(scene, order, is_shown);
        let indices = index_buffer(gpu, drawing.triangles.as_flattened());
        Self { indices, batches, drawing: Arc::new(drawing), ..self.clone() }
    }

    /// Returns the triangles that may be in view. In each batch the nearest chunks come first, so that hidden pixels
    /// are not shaded. Culled backs are dropped here, because a software driver transforms every triangle that it
    /// receives.
    pub(super) fn in_view(&self, gpu: &Gpu, from: &CullView) -> Self {
        let mut near: Vec<(f32, &Chunk)> =
            self.drawing.chunks.iter().filter_map(|c| Some((from.distance(&c.bounds)?, c))).collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut indices: Vec<[u32; 3]> = Vec::new();
        let mut batches = Vec::new();
        for (number, batch) in self.batches.iter().enumerate() {
            let first = 3 * indices.len() as u32;
            let is_culled = batch.faces.are_culled(from.cull_back);
            // Triangles that blend stay in the order of the file.
            let chunks: &mut dyn Iterator<Item = &Chunk> = match batch.alpha_mode {
                AlphaMode::Blend => &mut self.drawing.chunks.iter(),
                AlphaMode::Opaque | AlphaMode::Mask { .. } => &mut near.iter().map(|(_, chunk)| *chunk),
            };
            for chunk in chunks.filter(|chunk| chunk.batch == number) {
                let range = chunk.indices.start as usize / 3..chunk.indices.end as usize / 3;
                let triangles = self.drawing.triangles[range.clone()].iter().zip(&self.drawing.planes[range]);
                let seen = triangles.filter(|(_, plane)| !is_culled || plane.dot(from.eye) > 0.0);
                indices.extend(seen.map(|(triangle, _)| triangle));
            }
            let last = 3 * indices.len() as u32;
            if last > first {
                batches.push(DrawBatch { indices: first..last, ..batch.clone() });
            }
        }
        Self { indices: index_buffer(gpu, indices.as_flattened()), batches, ..self.clone() }
    }
}

/// Sorts the tiles into the order of drawing, in which their corners are uploaded.
fn sort_tiles(coarse: &mut CoarseMesh, scene: &Scene) {
    let num_tiled = coarse.tiles.len();
    let drawn = MeshTriangles { triangles: &coarse.triangles, num_tiled };
    let order = drawn.order(scene, |_| true).triangles;
    let tiles: Vec<usize> = order.iter().map(|id| id.index()).filter(|&tile| tile < num_tiled).collect();
    let triangles: Vec<Triangle> = tiles.iter().map(|&tile| coarse.triangles[tile]).collect();
    coarse.triangles[..num_tiled].copy_from_slice(&triangles);
    coarse.tiles = tiles.iter().map(|&tile| coarse.tiles[tile]).collect();
}

impl Mesh {
    /// Returns the batches, and all triangles in the order of drawing.
    fn drawing(
        &self,
        scene: &Scene,
        order: &VertexOrder,
        is_shown: impl Fn(&Triangle) -> bool,
    ) -> (Vec<DrawBatch>, Drawing) {
        let drawn = MeshTriangles { triangles: &self.triangles, num_tiled: self.num_tiles };
        let DrawOrder { batches, chunks, triangles } = drawn.order(scene, is_shown);
        let vertices = |id: &TriangleId| match id.index() {
            tile if tile < self.num_tiles => [0, 1, 2].map(|corner| 3 * tile as u32 + corner),
            triangle => self.triangles[triangle].vertices.map(|v| order.place(v)),
        };
        let plane = |id: &TriangleId| {
            let corners = self.triangles[id.index()].vertices.map(|v| scene.vertices[v as usize].position);
            let normal = edge_cross(corners);
            normal.extend(-normal.dot(corners[0]))
        };
        let planes = triangles.iter().map(plane).collect();
        (batches, Drawing { chunks, triangles: triangles.iter().map(vertices).collect(), planes })
    }
}

/// Returns the attributes of a tile's corners (shaders/surface/pass.wgsl), for a texture `texture` texels wide.
fn corners_of(tile: &Tile, texture: f32) -> [[Vec3; 2]; 3] {
    // The centre of the first texel.
    let first = (tile.origin.as_vec2() + 0.5) / texture;
    let width = tile.side as f32 / texture;
    [Vec2::ZERO, Vec2::X, Vec2::Y].map(|corner| [corner.extend(first.x), Vec3::new(first.y, width, 0.0)])
}
