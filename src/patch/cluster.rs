//! Patches: clusters of neighbouring elements with similar normals.
//!
//! Real scenes have many tiny triangles, and a hemicube for each would be too many. A patch is a set of elements of one
//! instance and material, within one cell of a grid and with normals in one bin, that are connected by shared edges or
//! lie close together. It shoots as one.
//!
//! Source: Cohen, Greenberg, Immel, Brock 1986 (patches and elements); Willmott, Heckbert, Garland 1999 (face
//! clusters).

use glam::{IVec3, Vec3};
use rustc_hash::FxHashMap;

use super::mesh::{Element, Patch, PatchMesh};
use crate::base::ids::{ElementId, PatchId};
use crate::scene::{Scene, normal_of};

/// Scale of normals on the cube from -1 to 1, before they are rounded to bins: 3 x 3 bins per face, each about 40
/// degrees wide.
const NORMAL_CELLS: f32 = 1.5;

/// Cell size of a grid, relative to the patch size. Elements whose centroids share a cell are joined even without a
/// shared edge, because many scenes consist of separate small pieces.
const CLOSE: f32 = 0.25;

/// Groups the elements of `mesh` into patches about `patch_size` metres wide.
pub(super) fn cluster(mesh: &mut PatchMesh, scene: &Scene, patch_size: f32) {
    let mut clusters = UnionFind::new(mesh.elements.len());
    let keys: Vec<Key> = mesh.elements.iter().map(|element| key_of(mesh, scene, element, patch_size)).collect();
    join_across_edges(mesh, &keys, &mut clusters);
    join_close(mesh, &keys, patch_size * CLOSE, &mut clusters);
    number_patches(mesh, &mut clusters);
    list_members(mesh);
}

/// Elements with different keys never share a patch.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Key {
    cell: IVec3,
    normal_bin: IVec3,
    material: u32,
    instance: u32,
}

fn key_of(mesh: &PatchMesh, scene: &Scene, element: &Element, patch_size: f32) -> Key {
    let triangle = &scene.triangles[element.triangle.index()];
    // An irregular shift keeps walls at round coordinates away from the cell borders.
    let shifted = mesh.centroid(element) / patch_size + Vec3::new(0.137, 0.291, 0.413);
    let normal = normal_of(mesh.corners(element));
    let on_cube = normal / normal.abs().max_element().max(1e-6);
    Key {
        cell: shifted.floor().as_ivec3(),
        normal_bin: (on_cube * NORMAL_CELLS).round().as_ivec3(),
        material: triangle.material.0,
        instance: triangle.instance.0,
    }
}

/// Unites elements of equal key that share an edge of the mesh.
fn join_across_edges(mesh: &PatchMesh, keys: &[Key], clusters: &mut UnionFind) {
    // Edges are identified by position, so that creases and texture seams do not divide a patch.
    let mut places: FxHashMap<[u32; 3], u32> = FxHashMap::default();
    let place_of: Vec<u32> = mesh
        .light_vertices
        .iter()
        .map(|vertex| {
            let next = places.len() as u32;
            *places.entry((vertex.position + Vec3::ZERO).to_array().map(f32::to_bits)).or_insert(next)
        })
        .collect();
    let mut edges: Vec<([u32; 2], u32)> = Vec::with_capacity(3 * mesh.elements.len());
    for (e, element) in mesh.elements.iter().enumerate() {
        let corners = mesh.light_vertices_of(element).map(|l| place_of[l]);
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            edges.push(([a.min(b), a.max(b)], e as u32));
        }
    }
    edges.sort_unstable();
    for on_edge in edges.chunk_by(|a, b| a.0 == b.0) {
        for (i, &(_, e)) in on_edge.iter().enumerate() {
            for &(_, other) in &on_edge[i + 1..] {
                if keys[e as usize] == keys[other as usize] {
                    clusters.unite(e, other);
                }
            }
        }
    }
}

/// Unites elements of equal key within one cell of a grid of `size` metres.
fn join_close(mesh: &PatchMesh, keys: &[Key], size: f32, clusters: &mut UnionFind) {
    let mut first_of: FxHashMap<(Key, IVec3), u32> = FxHashMap::default();
    for (e, element) in mesh.elements.iter().enumerate() {
        let cell = (mesh.centroid(element) / size).floor().as_ivec3();
        let first = *first_of.entry((keys[e], cell)).or_insert(e as u32);
        clusters.unite(first, e as u32);
    }
}

/// Gives every cluster a patch id, in the order of its first element.
fn number_patches(mesh: &mut PatchMesh, clusters: &mut UnionFind) {
    let mut patch_of_root: FxHashMap<u32, PatchId> = FxHashMap::default();
    for e in 0..mesh.elements.len() {
        let next = PatchId::new(patch_of_root.len());
        mesh.elements[e].patch = *patch_of_root.entry(clusters.root(e as u32)).or_insert(next);
    }
    mesh.patches = vec![Patch { members: 0..0, area: 0.0 }; patch_of_root.len()];
}

/// Sorts the elements by patch and sums areas.
fn list_members(mesh: &mut PatchMesh) {
    mesh.members = (0..mesh.elements.len()).map(ElementId::new).collect();
    mesh.members.sort_by_key(|e| mesh.elements[e.index()].patch);
    let mut start = 0;
    for members in mesh.members.chunk_by(|a, b| mesh.elements[a.index()].patch == mesh.elements[b.index()].patch) {
        let patch = &mut mesh.patches[mesh.elements[members[0].index()].patch.index()];
        patch.members = start..start + members.len();
        patch.area = members.iter().map(|e| mesh.elements[e.index()].area).sum();
        start += members.len();
    }
}

/// Disjoint sets with path halving. The root of a set is its smallest element, so numbering does not depend on the
/// order of the joins.
struct UnionFind(Vec<u32>);

impl UnionFind {
    fn new(size: usize) -> Self {
        Self((0..size as u32).collect())
    }

    fn root(&mut self, mut item: u32) -> u32 {
        while self.0[item as usize] != item {
            self.0[item as usize] = self.0[self.0[item as usize] as usize];
            item = self.0[item as usize];
        }
        item
    }

    fn unite(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}
