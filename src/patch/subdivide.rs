//! Divides triangles into elements by longest-edge bisection.
//!
//! A triangle whose longest edge exceeds the element size is halved at the midpoint of that edge, and so are its
//! halves. Every edge that is too long is thereby split at its midpoint in both triangles that share it. So the mesh
//! stays conforming although each triangle is cut independently. No angle is smaller than half the smallest angle of
//! the input.
//!
//! Source: Rivara 1984, "Algorithms for refining triangular grids"; Baum, Mann, Smith, Winget 1991 (why T-vertices
//! hurt).

use glam::Vec3;
use rustc_hash::FxHashMap;
use thiserror::Error;

use super::mesh::{Element, LightKey, LightVertex, PatchMesh, Root, light_key};
use super::splits::Splits;
use super::tree::Node;
use crate::base::ids::{PatchId, TriangleId};
use crate::scene::{Scene, Vertex};

/// Largest number of elements: an id must fit in a node beside the depth and the kind.
const MAX_ELEMENTS: usize = 1 << 26;

/// Largest depth of a regular tree that fits in a node.
const MAX_REGULAR_DEPTH: u32 = 15;

/// Reasons why a scene cannot be cut.
#[derive(Debug, Error)]
pub enum MeshError {
    /// The element size is too small.
    #[error("an element size of {element_size} m gives more than {max} elements; choose a larger one", max = MAX_ELEMENTS)]
    TooManyElements {
        /// Element size, metres.
        element_size: f32,
    },
    /// The scene has no triangles.
    #[error("the scene has no triangles")]
    Empty,
}

/// Cuts all triangles of the scene at the edges that are longer than the element size or in `splits`. Optics and
/// patches of the elements are not yet set.
pub(super) fn subdivide(scene: &Scene, element_size: f32, splits: &Splits) -> Result<PatchMesh, MeshError> {
    if scene.triangles.is_empty() {
        return Err(MeshError::Empty);
    }
    let mut cutter = Cutter::new(scene, element_size, splits);
    for t in 0..scene.triangles.len() {
        cutter.cut(scene, TriangleId::new(t));
        if cutter.mesh.elements.len() > MAX_ELEMENTS {
            return Err(MeshError::TooManyElements { element_size });
        }
    }
    Ok(cutter.mesh)
}

struct Cutter<'a> {
    splits: &'a Splits,
    mesh: PatchMesh,
    max_edge_squared: f32,
    /// Midpoint vertex of a pair of vertices.
    midpoints: FxHashMap<[u32; 2], u32>,
    /// Midpoint light vertex of a pair of light vertices.
    light_midpoints: FxHashMap<[u32; 2], u32>,
    /// Flipped copies of input vertices, for the backs of double-sided triangles.
    flipped: FxHashMap<u32, u32>,
    /// Welded light vertices by position bits and quantised normal.
    welded: FxHashMap<LightKey, u32>,
}

impl<'a> Cutter<'a> {
    fn new(scene: &Scene, element_size: f32, splits: &'a Splits) -> Self {
        let mut cutter = Self {
            splits,
            mesh: PatchMesh::default(),
            max_edge_squared: element_size * element_size,
            midpoints: FxHashMap::default(),
            light_midpoints: FxHashMap::default(),
            flipped: FxHashMap::default(),
            welded: FxHashMap::default(),
        };
        for vertex in &scene.vertices {
            cutter.add_welded(*vertex);
        }
        cutter
    }

    fn cut(&mut self, scene: &Scene, triangle: TriangleId) {
        let corners = scene.triangles[triangle.index()].vertices;
        let has_backs = scene.material_of(triangle).double_sided;
        let first_element = self.mesh.elements.len();
        let node = self.bisect(corners, triangle);
        let fronts = self.mesh.elements.len() - first_element;
        if has_backs {
            self.add_backs(first_element..first_element + fronts, corners);
        }
        self.mesh.roots.push(Root {
            node,
            first_element: first_element as u32,
            num_elements: fronts as u32,
            has_backs,
        });
    }

    /// Cuts a triangle and returns the node of its tree.
    fn bisect(&mut self, corners: [u32; 3], triangle: TriangleId) -> Node {
        let places = corners.map(|v| self.mesh.vertices[v as usize].position);
        let (apex, length_squared) = longest_edge(places);
        let [_, from, to] = [0, 1, 2].map(|k| places[(apex + k) % 3]);
        if length_squared <= self.max_edge_squared && !self.splits.contains(from, to) {
            self.mesh.elements.push(blank_element(corners, triangle, false));
            return Node::regular(self.mesh.elements.len() as u32 - 1, 0);
        }
        let [at_apex, first, second] = [0, 1, 2].map(|k| corners[(apex + k) % 3]);
        let midpoint = self.midpoint(first, second);
        let children =
            [self.bisect([midpoint, at_apex, first], triangle), self.bisect([midpoint, second, at_apex], triangle)];
        match children.map(Node::as_regular) {
            [Some((first_element, depth)), Some((_, other))]
                if apex == 0 && depth == other && depth < MAX_REGULAR_DEPTH =>
            {
                Node::regular(first_element, depth + 1)
            }
            _ => {
                self.mesh.tree.extend(children);
                Node::split(apex, self.mesh.tree.len() as u32 - 2)
            }
        }
    }

    /// Adds the back faces of elements. Their vertices are copies with flipped normals.
    fn add_backs(&mut self, fronts: std::ops::Range<usize>, corners: [u32; 3]) {
        for corner in corners {
            self.flipped_copy(corner);
        }
        for front in fronts {
            let element = self.mesh.elements[front];
            let [a, b, c] = element.vertices.map(|v| self.flipped_copy(v));
            self.mesh.elements.push(blank_element([a, c, b], element.triangle, true));
        }
    }

    fn flipped_copy(&mut self, vertex: u32) -> u32 {
        if let Some(&copy) = self.flipped.get(&vertex) {
            return copy;
        }
        let front = self.mesh.vertices[vertex as usize];
        let copy = self.add_welded(Vertex { normal: -front.normal, ..front });
        self.flipped.insert(vertex, copy);
        copy
    }

    fn midpoint(&mut self, a: u32, b: u32) -> u32 {
        let pair = [a.min(b), a.max(b)];
        if let Some(&midpoint) = self.midpoints.get(&pair) {
            return midpoint;
        }
        let [low, high] = pair.map(|v| self.mesh.vertices[v as usize]);
        let light_pair = pair.map(|v| self.mesh.light_vertex_of[v as usize]);
        let light_pair = [light_pair[0].min(light_pair[1]), light_pair[0].max(light_pair[1])];
        let light_vertex = match self.light_midpoints.get(&light_pair) {
            Some(&light_vertex) => light_vertex,
            None => self.add_light_midpoint(light_pair),
        };
        // Position and normal come from the light vertices, so that both sides of a texture seam keep one light vertex.
        let LightVertex { position, normal } = self.mesh.light_vertices[light_vertex as usize];
        let uv = [0, 1].map(|set| (low.uv[set] + high.uv[set]) * 0.5);
        let vertex = Vertex { position, normal, uv, colour: (low.colour + high.colour) * 0.5 };
        let midpoint = self.add_vertex(vertex, light_vertex);
        self.midpoints.insert(pair, midpoint);
        midpoint
    }

    fn add_light_midpoint(&mut self, pair: [u32; 2]) -> u32 {
        let [low, high] = pair.map(|l| self.mesh.light_vertices[l as usize]);
        let light_vertex = self.mesh.light_vertices.len() as u32;
        self.mesh.light_vertices.push(LightVertex::between(low, high));
        self.light_midpoints.insert(pair, light_vertex);
        light_vertex
    }

    /// Adds a vertex of the input; vertices with one position and shading normal share a light vertex.
    fn add_welded(&mut self, vertex: Vertex) -> u32 {
        let key = light_key(vertex.position, vertex.normal);
        let next = self.mesh.light_vertices.len() as u32;
        let light_vertex = *self.welded.entry(key).or_insert(next);
        if light_vertex == next {
            self.mesh.light_vertices.push(LightVertex { position: vertex.position, normal: vertex.normal });
        }
        self.add_vertex(vertex, light_vertex)
    }

    fn add_vertex(&mut self, vertex: Vertex, light_vertex: u32) -> u32 {
        self.mesh.vertices.push(vertex);
        self.mesh.light_vertex_of.push(light_vertex);
        self.mesh.vertices.len() as u32 - 1
    }
}

/// Returns the corner opposite the longest edge, and the squared length of that edge.
pub(super) fn longest_edge(at: [Vec3; 3]) -> (usize, f32) {
    let squared = [0, 1, 2].map(|k| at[(k + 1) % 3].distance_squared(at[(k + 2) % 3]));
    let apex = if squared[0] >= squared[1] && squared[0] >= squared[2] {
        0
    } else if squared[1] >= squared[2] {
        1
    } else {
        2
    };
    (apex, squared[apex])
}

fn blank_element(vertices: [u32; 3], triangle: TriangleId, is_back: bool) -> Element {
    Element {
        vertices,
        triangle,
        is_back,
        patch: PatchId(0),
        area: 0.0,
        reflectance: Vec3::ZERO,
        exitance: Vec3::ZERO,
        group: None,
    }
}
