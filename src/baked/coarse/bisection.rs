//! The bisection trees of a mesh, found again from its triangles.
//!
//! A bake has the elements of an input triangle one behind the other, halves of halves (`patch::subdivide`). So two
//! neighbours in the order of triangles that share an edge from the middle of their common base to their common apex are
//! halves of one triangle, and so on upwards. Of meshes that were never bisected a few pairs look so too, which does no harm:
//! whatever is linear in such a pair is linear in the triangle that they make.

use glam::{IVec2, Vec2, Vec3, Vec4};

use crate::base::ids::TriangleId;
use crate::scene::{AlphaMode, Scene, Triangle};

/// How far the middle of an edge may be from where it belongs: rounding of the transforms that a file went through.
const ROUNDING: f32 = 1e-5;
/// How far colours may be, which files keep in as little as eight bits.
const COLOUR_ROUNDING: f32 = 4e-3;
/// Least cosine between a shading normal and that of the edge it lies on.
const SAME_NORMAL: f32 = 0.999;

/// A triangle of the mesh, or one that two others make up.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Node {
    /// Vertices of the scene. Where there are halves the apex comes first.
    pub corners: [u32; 3],
    /// The other two corners end the edge that was halved.
    pub halves: Option<Halves>,
    /// Triangles of the mesh that it is made of.
    pub num_elements: u32,
}

/// The two nodes that make up one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Halves {
    pub nodes: [u32; 2],
    /// Vertex in the middle of the edge that was halved.
    pub middle: u32,
}

/// The nodes of all trees.
#[derive(Debug, Default)]
pub(super) struct Forest {
    /// First the triangles of the mesh, in their order.
    pub nodes: Vec<Node>,
    /// The node that each is a half of.
    pub parents: Vec<Option<u32>>,
}

impl Forest {
    /// The largest trees that there are. What blends is drawn triangle by triangle in the order of the file, and has none.
    pub fn new(scene: &Scene) -> Self {
        let leaf = |triangle: &Triangle| Node { corners: triangle.vertices, halves: None, num_elements: 1 };
        let mut forest = Self { nodes: scene.triangles.iter().map(leaf).collect(), parents: Vec::new() };
        forest.parents = vec![None; forest.nodes.len()];
        let kind = |t: usize| {
            let triangle = &scene.triangles[t];
            (triangle.instance, triangle.material, scene.sides.is_back(TriangleId::new(t)))
        };
        let mut unpaired: Vec<u32> = Vec::new();
        for (t, triangle) in scene.triangles.iter().enumerate() {
            let goes_on = t > 0 && kind(t) == kind(t - 1);
            if !goes_on || scene.materials[triangle.material.index()].alpha_mode == AlphaMode::Blend {
                unpaired.clear();
            }
            unpaired.push(t as u32);
            while let [.., first, second] = unpaired[..]
                && let Some(node) = forest.pair(scene, [first, second])
            {
                unpaired.truncate(unpaired.len() - 2);
                let number = forest.nodes.len() as u32;
                unpaired.push(number);
                forest.parents[first as usize] = Some(number);
                forest.parents[second as usize] = Some(number);
                forest.nodes.push(node);
                forest.parents.push(None);
            }
        }
        forest
    }

    /// The node that two others are the halves of.
    fn pair(&self, scene: &Scene, nodes: [u32; 2]) -> Option<Node> {
        let [first, second] = nodes.map(|node| &self.nodes[node as usize]);
        let (i, j) = (0..9).map(|k| (k / 3, k % 3)).find(|&(i, j)| {
            // The same edge, the other way round.
            first.corners[i] == second.corners[(j + 1) % 3] && first.corners[(i + 1) % 3] == second.corners[j]
        })?;
        let (from, to) = (first.corners[i], first.corners[(i + 1) % 3]);
        let (left, right) = (first.corners[(i + 2) % 3], second.corners[(j + 2) % 3]);
        let (corners, middle) = if is_middle(scene, from, [left, right]) {
            ([to, left, right], from)
        } else if is_middle(scene, to, [left, right]) {
            ([from, right, left], to)
        } else {
            return None;
        };
        let num_elements = first.num_elements + second.num_elements;
        Some(Node { corners, halves: Some(Halves { nodes, middle }), num_elements })
    }

    /// One of the triangles of the mesh that make up a node.
    pub fn some_element(&self, mut node: u32) -> u32 {
        while let Some(halves) = self.nodes[node as usize].halves {
            [node, _] = halves.nodes;
        }
        node
    }

    /// Tells the triangles of the mesh that make up a node, and the places of their corners, given the places of the node's.
    pub fn visit(&self, node: u32, places: [IVec2; 3], tell: &mut impl FnMut(u32, [IVec2; 3])) {
        let Node { corners, halves, .. } = &self.nodes[node as usize];
        let Some(Halves { nodes, middle }) = *halves else {
            return tell(node, places);
        };
        let place_of = |vertex: u32| match corners.iter().position(|&corner| corner == vertex) {
            Some(k) => places[k],
            None => (places[1] + places[2]) / 2,
        };
        debug_assert!(!corners.contains(&middle));
        for half in nodes {
            self.visit(half, self.nodes[half as usize].corners.map(place_of), tell);
        }
    }
}

/// A vertex lies in the middle of an edge in all that is linear in a triangle, and has a normal that suits.
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
