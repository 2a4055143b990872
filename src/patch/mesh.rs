//! The mesh that light is solved on: elements receive, patches shoot, light vertices carry the result.

use std::ops::Range;

use glam::{IVec3, Vec3};

use super::tree::Node;
use crate::base::ids::{ElementId, GroupId, PatchId, TriangleId};
use crate::scene::Vertex;

/// Sizes of elements and patches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshSettings {
    /// Longest edge of an element, metres.
    pub element_size: f32,
    /// Width of a patch, metres: elements within a cell of this size shoot as one.
    pub patch_size: f32,
}

impl MeshSettings {
    /// Settings that leave every triangle of the scene whole, as one element.
    #[must_use]
    pub const fn uncut() -> Self {
        Self { element_size: f32::INFINITY, patch_size: f32::INFINITY }
    }
}

/// Elements, patches and the vertices that carry light.
#[derive(Clone, Debug, Default)]
pub struct PatchMesh {
    /// Vertices `[v]` of the elements: those of the scene, flipped copies for backs, and edge midpoints.
    pub vertices: Vec<Vertex>,
    /// The light vertex of each vertex `[v]`.
    pub light_vertex_of: Vec<u32>,
    /// Points `[l]` at which irradiance is stored.
    pub light_vertices: Vec<LightVertex>,
    /// Elements `[e]`: the fronts of one input triangle one after the other, then its backs in the same order.
    pub elements: Vec<Element>,
    /// Patches `[p]`.
    pub patches: Vec<Patch>,
    /// Elements of all patches, patch by patch.
    pub members: Vec<ElementId>,
    /// Children of the nodes of all bisection trees, in pairs.
    pub tree: Vec<Node>,
    /// Tree and element range of each input triangle `[t]`.
    pub roots: Vec<Root>,
}

/// A point at which irradiance is stored, shared by all elements that meet there with one shading normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightVertex {
    /// Position, metres.
    pub position: Vec3,
    /// Unit shading normal.
    pub normal: Vec3,
}

impl LightVertex {
    /// The vertex at the middle of an edge.
    #[must_use]
    pub fn between(a: Self, b: Self) -> Self {
        let normal = (a.normal + b.normal).try_normalize().unwrap_or(a.normal);
        Self { position: (a.position + b.position) * 0.5, normal }
    }
}

/// Identifies a light vertex by position and shading normal, in any mesh of the scene.
pub type LightKey = ([u32; 3], IVec3);

/// The key of a light vertex.
#[must_use]
pub fn light_key(position: Vec3, normal: Vec3) -> LightKey {
    // Adding zero turns -0 into +0.
    ((position + Vec3::ZERO).to_array().map(f32::to_bits), (normal * 1000.0).round().as_ivec3())
}

/// The smallest receiver of light: a triangle that is a part of one input triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element {
    /// Vertices `[v]`, counter-clockwise as seen from the side that reflects.
    pub vertices: [u32; 3],
    /// The input triangle that contains it.
    pub triangle: TriangleId,
    /// True if it lies on the back of a double-sided triangle.
    pub is_back: bool,
    /// The patch it shoots with.
    pub patch: PatchId,
    /// Solid area, square metres: area x mean opacity.
    pub area: f32,
    /// Mean diffuse reflectance of the solid part, per channel.
    pub reflectance: Vec3,
    /// Mean exitance of the solid part: pi x emitted radiance, lux per channel.
    pub exitance: Vec3,
    /// Light group of the exitance. `None` if it emits nothing.
    pub group: Option<GroupId>,
}

/// Neighbouring elements with similar normals that shoot as one.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// Its elements: a range of [`PatchMesh::members`].
    pub members: Range<usize>,
    /// Solid area, square metres.
    pub area: f32,
}

/// Locates the bisection tree and the elements of an input triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Root {
    /// Root of the bisection tree.
    pub node: Node,
    /// First front element.
    pub first_element: u32,
    /// Number of elements on one side. The back of front element `e` is `e + num_elements`, if there are backs.
    pub num_elements: u32,
    /// True if the triangle is double-sided and therefore has backs.
    pub has_backs: bool,
}

impl PatchMesh {
    /// Corner positions of an element, metres.
    #[must_use]
    pub fn corners(&self, element: &Element) -> [Vec3; 3] {
        element.vertices.map(|v| self.vertices[v as usize].position)
    }

    /// Centroid of an element, metres.
    #[must_use]
    pub fn centroid(&self, element: &Element) -> Vec3 {
        let [a, b, c] = self.corners(element);
        (a + b + c) / 3.0
    }

    /// Elements of a patch.
    #[must_use]
    pub fn members_of(&self, patch: &Patch) -> &[ElementId] {
        &self.members[patch.members.clone()]
    }

    /// Light vertices of an element's corners.
    #[must_use]
    pub fn light_vertices_of(&self, element: &Element) -> [usize; 3] {
        element.vertices.map(|v| self.light_vertex_of[v as usize] as usize)
    }

    /// Elements on one side of an input triangle; empty for the back of a single-sided one.
    #[must_use]
    pub fn elements_of(&self, triangle: TriangleId, is_back: bool) -> &[Element] {
        let root = self.roots[triangle.index()];
        let (first, count) = (root.first_element as usize, root.num_elements as usize);
        match is_back {
            false => &self.elements[first..][..count],
            true if root.has_backs => &self.elements[first + count..][..count],
            true => &[],
        }
    }

    /// Returns the front element at a barycentric position of an input triangle.
    #[must_use]
    pub fn element_at(&self, triangle: TriangleId, barycentric: Vec3) -> ElementId {
        ElementId(self.roots[triangle.index()].node.element_at(&self.tree, barycentric))
    }
}
