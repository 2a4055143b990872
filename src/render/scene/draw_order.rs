//! Sorts triangles for drawing: by material, blending ones last, neighbours next to each other.

use wgpu::util::DeviceExt;

use super::draw_batch::{Chunk, DrawBatch, Faces};
use crate::base::ids::TriangleId;
use crate::gpu::Gpu;
use crate::scene::chunks::{CHUNK, chunk_bounds, spatial_order};
use crate::scene::{AlphaMode, Scene, Triangle};

/// Triangles in the order of drawing.
pub(super) struct DrawOrder {
    pub batches: Vec<DrawBatch>,
    pub chunks: Vec<Chunk>,
    pub triangles: Vec<TriangleId>,
}

/// Triangles of a mesh, some of which have their light in tiles.
pub(super) struct MeshTriangles<'a> {
    /// Triangles that index a scene's vertices and materials.
    pub triangles: &'a [Triangle],
    /// Number of triangles whose light is in tiles. They come first.
    pub num_tiled: usize,
}

impl MeshTriangles<'_> {
    /// Sorts the triangles for which `is_shown` returns true by material, those that blend last, and cuts them into
    /// batches and chunks.
    pub fn order(&self, scene: &Scene, is_shown: impl Fn(&Triangle) -> bool) -> DrawOrder {
        let has_twins = scene.sides.has_backs();
        let material_of = |id: &TriangleId| self.triangles[id.index()].material;
        let blends = |id: &TriangleId| scene.materials[material_of(id).index()].alpha_mode == AlphaMode::Blend;
        let key = |id: &TriangleId| (blends(id), material_of(id), id.index() >= self.num_tiled);
        let corners = |id: TriangleId| self.triangles[id.index()].vertices.map(|v| scene.vertices[v as usize].position);
        let all = (0..self.triangles.len()).map(TriangleId::new);
        let mut triangles: Vec<TriangleId> = all.filter(|id| is_shown(&self.triangles[id.index()])).collect();
        triangles.sort_by_key(key);
        let mut order = DrawOrder { batches: Vec::new(), chunks: Vec::new(), triangles: Vec::new() };
        for same in triangles.chunk_by(|a, b| key(a) == key(b)) {
            // Triangles that blend stay in the order of the file.
            let same = if blends(&same[0]) { same.to_vec() } else { spatial_order(corners, same.iter().copied()) };
            let start = 3 * order.triangles.len() as u32;
            let triangle_at = |place: usize| start + 3 * place.min(same.len()) as u32;
            for (i, bounds) in chunk_bounds(corners, &same).into_iter().enumerate() {
                let indices = triangle_at(i * CHUNK)..triangle_at((i + 1) * CHUNK);
                order.chunks.push(Chunk { batch: order.batches.len(), indices, bounds });
            }
            let material = &scene.materials[material_of(&same[0]).index()];
            let faces = match (material.double_sided, has_twins) {
                (false, _) => Faces::Front,
                (true, true) => Faces::FrontOfTwins,
                (true, false) => Faces::Both,
            };
            order.batches.push(DrawBatch {
                indices: start..triangle_at(same.len()),
                material: material_of(&same[0]),
                alpha_mode: material.alpha_mode,
                faces,
                has_textures: material.base_colour_texture.is_some()
                    || material.metallic_roughness_texture.is_some()
                    || material.emissive_texture.is_some(),
                is_unlit: material.unlit,
                is_tiled: same[0].index() < self.num_tiled,
            });
            order.triangles.extend(same);
        }
        order
    }
}

impl DrawOrder {
    /// Returns the index buffer: three vertices a triangle.
    pub fn indices(&self, vertices: impl Fn(TriangleId) -> [u32; 3]) -> Vec<u32> {
        self.triangles.iter().flat_map(|&id| vertices(id)).collect()
    }
}

/// Returns the triangles of a scene in the order of drawing, and three vertex indices for each.
pub(super) fn draw_order(scene: &Scene, is_shown: impl Fn(&Triangle) -> bool) -> (DrawOrder, Vec<u32>) {
    let order = MeshTriangles { triangles: &scene.triangles, num_tiled: 0 }.order(scene, is_shown);
    let indices = order.indices(|id| scene.triangles[id.index()].vertices);
    (order, indices)
}

pub(super) fn index_buffer(gpu: &Gpu, indices: &[u32]) -> wgpu::Buffer {
    gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("scene indices"),
        contents: bytemuck::cast_slice(indices),
        usage: wgpu::BufferUsages::INDEX,
    })
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::base::ids::{InstanceId, MaterialId};
    use crate::scene::{Material, Vertex, builtin};

    fn triangle(material: u32) -> Triangle {
        Triangle { vertices: [material; 3], material: MaterialId(material), instance: InstanceId(0) }
    }

    fn scene_of(modes: &[(AlphaMode, bool)], triangles: Vec<Triangle>) -> Scene {
        let material = |&(alpha_mode, double_sided)| Material { alpha_mode, double_sided, ..Material::default() };
        let vertex = Vertex::new(Vec3::ZERO, Vec3::Y);
        let vertices = vec![vertex; modes.len()];
        Scene { materials: modes.iter().map(material).collect(), vertices, triangles, ..Scene::default() }
    }

    #[test]
    fn blending_triangles_are_drawn_last() {
        let modes = [(AlphaMode::Blend, false), (AlphaMode::Opaque, false)];
        let scene = scene_of(&modes, vec![triangle(0), triangle(1), triangle(0)]);
        let (order, indices) = draw_order(&scene, |_| true);
        assert_eq!(indices, [1, 1, 1, 0, 0, 0, 0, 0, 0]);
        assert_eq!(order.batches.iter().map(|b| b.indices.clone()).collect::<Vec<_>>(), [0..3, 3..9]);
    }

    #[test]
    fn double_sided_triangles_are_culled_only_if_their_twins_exist() {
        let modes = [(AlphaMode::Opaque, true), (AlphaMode::Opaque, false)];
        let faces =
            |scene: &Scene| -> Vec<Faces> { draw_order(scene, |_| true).0.batches.iter().map(|b| b.faces).collect() };
        assert_eq!(faces(&scene_of(&modes, vec![triangle(0), triangle(1)])), [Faces::Both, Faces::Front]);
        let mut baked = scene_of(&modes, vec![triangle(0), triangle(0)]);
        baked.sides.add_back(TriangleId(1));
        assert_eq!(faces(&baked), [Faces::FrontOfTwins]);
    }

    #[test]
    fn chunks_are_consecutive_pieces_of_the_batches() {
        let scene = builtin::gallery();
        let (order, indices) = draw_order(&scene, |_| true);
        assert!(order.chunks.len() > order.batches.len());
        let mut end = 0;
        for chunk in &order.chunks {
            let batch = &order.batches[chunk.batch].indices;
            assert!(chunk.indices.start == end && batch.start <= end && chunk.indices.end <= batch.end);
            end = chunk.indices.end;
            for &vertex in &indices[chunk.indices.start as usize..end as usize] {
                let p = scene.vertices[vertex as usize].position;
                assert!(p.cmpge(chunk.bounds.low).all() && p.cmple(chunk.bounds.high).all());
            }
        }
        assert_eq!(end as usize, indices.len());
    }
}
