//! The forest of all bisection trees of a mesh, with the corners of every node.
//!
//! The trees are those that the bake recorded ([`BisectionTrees`]). For files without records they are guessed. The
//! elements of an input triangle are consecutive, halves of halves (`patch::subdivide`). So if two consecutive
//! triangles share an edge from the middle of their common base to their common apex, they are taken as halves of one
//! triangle; the same test is applied to the joined triangles. A few pairs of triangles that were never bisected pass
//! it too. That does no harm, because a function that is linear on both is linear on their union.

use glam::{IVec2, Vec2, Vec3, Vec4};

use crate::baked::bisection_trees::{BisectionTrees, Halving};
use crate::base::ids::TriangleId;
use crate::scene::{AlphaMode, Scene, Triangle};

/// Largest distance of a vertex from the middle of an edge that is due to rounding of transforms, relative to the
/// length of the edge.
const ROUNDING: f32 = 1e-5;
/// Largest deviation of colours that is due to rounding: files may store colours in eight bits.
const COLOUR_ROUNDING: f32 = 4e-3;
/// Smallest cosine between the shading normals of a vertex and of the edge that it lies on.
const SAME_NORMAL: f32 = 0.999;

/// A triangle of the mesh, or the union of two nodes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Node {
    /// Vertices in the scene. If the node has halves, the apex comes first.
    pub corners: [u32; 3],
    /// The two nodes of which it is the union. `None` for a triangle of the mesh.
    pub halves: Option<Halves>,
    /// Number of triangles of the mesh of which it consists.
    pub num_elements: u32,
}

/// The two halves of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Halves {
    pub nodes: [u32; 2],
    /// Vertex in the middle of the edge opposite the apex.
    pub middle: u32,
}

/// The nodes of all trees.
#[derive(Debug, Default)]
pub(super) struct Forest {
    /// First the triangles of the mesh, in their order.
    pub nodes: Vec<Node>,
    /// Parent of each node: the node of which it is a half. `None` for a root.
    pub parents: Vec<Option<u32>>,
}

impl Forest {
    /// Returns the trees of a scene: those that the bake recorded, if they fit, else those guessed from its triangles.
    pub fn new(scene: &Scene, kept: Option<&BisectionTrees>) -> Self {
        kept.and_then(|trees| Self::of_trees(scene, trees)).unwrap_or_else(|| Self::guessed(scene))
    }

    /// Returns the triangles of the mesh, which no tree joins yet.
    fn of_elements(scene: &Scene) -> Self {
        let leaf = |triangle: &Triangle| Node { corners: triangle.vertices, halves: None, num_elements: 1 };
        let nodes: Vec<Node> = scene.triangles.iter().map(leaf).collect();
        Self { parents: vec![None; nodes.len()], nodes }
    }

    /// Returns the trees that a bake recorded. `None` if they do not fit the triangles.
    ///
    /// Halves whose vertices have been moved apart since the bake are not joined.
    fn of_trees(scene: &Scene, trees: &BisectionTrees) -> Option<Self> {
        if trees.num_elements() != scene.triangles.len() {
            return None;
        }
        let mut forest = Self::of_elements(scene);
        for tree in trees.iter() {
            let first = TriangleId::new(tree.elements.start);
            if blends(scene, first) {
                continue;
            }
            let element = |e: usize| (Some(e as u32), scene.triangles[e].vertices);
            tree.visit(scene.sides.is_back(first), element, |halves: [Option<u32>; 2], halving| {
                let Halving { corners, middle } = halving;
                let is_joined = is_middle(scene, middle, [corners[1], corners[2]]);
                halves[0].zip(halves[1]).filter(|_| is_joined).map(|(a, b)| forest.join([a, b], corners, middle))
            })
            .ok()?;
        }
        Some(forest)
    }

    /// Returns the largest trees that agree with the order and the positions of the triangles.
    fn guessed(scene: &Scene) -> Self {
        let mut forest = Self::of_elements(scene);
        let surface = |t: usize| {
            let triangle = &scene.triangles[t];
            (triangle.instance, triangle.material, scene.sides.is_back(TriangleId::new(t)))
        };
        let mut unpaired: Vec<u32> = Vec::new();
        for t in 0..scene.triangles.len() {
            let goes_on = t > 0 && surface(t) == surface(t - 1);
            if !goes_on || blends(scene, TriangleId::new(t)) {
                unpaired.clear();
            }
            unpaired.push(t as u32);
            while let [.., first, second] = unpaired[..]
                && let Some((corners, middle)) = forest.pair(scene, [first, second])
            {
                unpaired.truncate(unpaired.len() - 2);
                unpaired.push(forest.join([first, second], corners, middle));
            }
        }
        forest
    }

    /// Adds the node whose halves are two other nodes, and returns its index.
    fn join(&mut self, halves: [u32; 2], corners: [u32; 3], middle: u32) -> u32 {
        let number = self.nodes.len() as u32;
        let num_elements = halves.iter().map(|&half| self.nodes[half as usize].num_elements).sum();
        self.nodes.push(Node { corners, halves: Some(Halves { nodes: halves, middle }), num_elements });
        self.parents.push(None);
        halves.into_iter().for_each(|half| self.parents[half as usize] = Some(number));
        number
    }

    /// If two nodes are the halves of a triangle, returns the corners of that triangle, apex first, and the vertex in
    /// the middle of its base. `None` otherwise.
    fn pair(&self, scene: &Scene, nodes: [u32; 2]) -> Option<([u32; 3], u32)> {
        let [first, second] = nodes.map(|node| &self.nodes[node as usize]);
        let (i, j) = (0..9).map(|k| (k / 3, k % 3)).find(|&(i, j)| {
            // The shared edge has opposite directions in the two triangles.
            first.corners[i] == second.corners[(j + 1) % 3] && first.corners[(i + 1) % 3] == second.corners[j]
        })?;
        let (from, to) = (first.corners[i], first.corners[(i + 1) % 3]);
        let (left, right) = (first.corners[(i + 2) % 3], second.corners[(j + 2) % 3]);
        if is_middle(scene, from, [left, right]) {
            Some(([to, left, right], from))
        } else if is_middle(scene, to, [left, right]) {
            Some(([from, right, left], to))
        } else {
            None
        }
    }

    /// Returns the first triangle of the mesh that belongs to a node.
    pub fn some_element(&self, mut node: u32) -> u32 {
        while let Some(halves) = self.nodes[node as usize].halves {
            [node, _] = halves.nodes;
        }
        node
    }

    /// Visits the triangles of the mesh of which a node consists, with the grid positions of their corners. `places`
    /// are the grid positions of the corners of the node.
    pub fn visit(&self, node: u32, places: [IVec2; 3], visit: &mut impl FnMut(u32, [IVec2; 3])) {
        let Node { corners, halves, .. } = &self.nodes[node as usize];
        let Some(Halves { nodes, middle }) = *halves else {
            return visit(node, places);
        };
        let place_of = |vertex: u32| match corners.iter().position(|&corner| corner == vertex) {
            Some(k) => places[k],
            None => (places[1] + places[2]) / 2,
        };
        debug_assert!(!corners.contains(&middle));
        for half in nodes {
            self.visit(half, self.nodes[half as usize].corners.map(place_of), visit);
        }
    }
}

/// Returns true if the material of a triangle blends. Such triangles are drawn one by one in the order of the file, so
/// no trees join them.
fn blends(scene: &Scene, triangle: TriangleId) -> bool {
    scene.material_of(triangle).alpha_mode == AlphaMode::Blend
}

/// Returns true if the position, texture coordinates and colour of a vertex are the means of those at the ends of an
/// edge, and its normal is near their mean normal.
fn is_middle(scene: &Scene, vertex: u32, ends: [u32; 2]) -> bool {
    let middle = &scene.vertices[vertex as usize];
    let [a, b] = ends.map(|end| &scene.vertices[end as usize]);
    let is_near = |value: Vec4, a: Vec4, b: Vec4, rounding: f32| {
        let bound = rounding * a.distance(b) + 4.0 * f32::EPSILON * (a.abs().max_element() + b.abs().max_element());
        value.distance(0.5 * (a + b)) <= bound
    };
    let place = |position: Vec3| position.extend(0.0);
    let coordinates = |[first, second]: [Vec2; 2]| Vec4::new(first.x, first.y, second.x, second.y);
    let normal = (a.normal + b.normal).normalize_or(a.normal);
    is_near(place(middle.position), place(a.position), place(b.position), ROUNDING)
        && is_near(coordinates(middle.uv), coordinates(a.uv), coordinates(b.uv), ROUNDING)
        && (middle.colour - 0.5 * (a.colour + b.colour)).abs().max_element() <= COLOUR_ROUNDING
        && middle.normal.dot(normal) >= SAME_NORMAL
}
