//! The scene: everything in world space, with look-ups by triangle.

use std::ops::Range;

use glam::Vec3;

use super::camera::Camera;
use super::light::Light;
use super::material::{Material, SurfacePoint};
use super::node::NamedNode;
use super::sides::Sides;
use super::texture::Texture;
use super::triangle::{Triangle, Vertex, area_of};
use crate::base::bounds::Bounds;
use crate::base::ids::{InstanceId, TriangleId};

/// A scene ready to be lit: everything in world space, metres, +Y up, counter-clockwise front faces.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// File stem, or the name of a built-in scene.
    pub name: String,
    /// Vertices `[v]`, as the file splits them (at seams of normals and texture coordinates).
    pub vertices: Vec<Vertex>,
    /// Triangles `[t]`; those of one instance are consecutive.
    pub triangles: Vec<Triangle>,
    /// Pairs of front and back triangles; only baked scenes have any.
    pub sides: Sides,
    /// Placed primitives `[i]`.
    pub instances: Vec<Instance>,
    /// The file's tree of nodes, parents first; empty if the scene does not come from a file.
    pub nodes: Vec<NamedNode>,
    /// Materials `[m]`.
    pub materials: Vec<Material>,
    /// Textures to which materials refer.
    pub textures: Vec<Texture>,
    /// Punctual lights.
    pub lights: Vec<Light>,
    /// Cameras in file order.
    pub cameras: Vec<Camera>,
    /// Names of the light groups `[g]`. Each light and each emissive material belongs to one.
    pub light_groups: Vec<String>,
    /// Baked light of the file: vertex attributes whose name begins with `_IRRADIANCE_`, one value per vertex.
    pub irradiance: Vec<VertexAttribute>,
    /// Records of a bake about the elements of instances, not validated; `baked::gltf::from_scene` checks and removes
    /// them.
    pub element_records: Vec<(InstanceId, ElementRecord)>,
    /// Names of the file's material variants; [`gltf::LoadOptions`](super::gltf::LoadOptions) selects one on loading.
    pub variants: Vec<String>,
    /// Number of triangles of the file that were dropped because they have no area.
    pub dropped_triangles: usize,
    /// Messages of the loader to the user, one line each.
    pub notes: Vec<String>,
}

/// A placed mesh primitive.
#[derive(Clone, Debug, Default)]
pub struct Instance {
    /// Name of the node, or of its mesh if the node has none.
    pub name: String,
    /// Its triangles.
    pub triangles: Range<usize>,
}

/// One vector per vertex under a glTF attribute name.
#[derive(Clone, Debug, PartialEq)]
pub struct VertexAttribute {
    /// Attribute name in the file.
    pub name: String,
    /// Values `[v]`.
    pub values: Vec<Vec3>,
}

/// Record of a bake about the triangles of a primitive, which are its elements: `elements` of the `extras` in the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ElementRecord {
    /// Version of the format of the record.
    pub version: u64,
    /// Bisection trees of the triangles, as text; `None` if the record has none.
    pub trees: Option<String>,
    /// If the triangles are backs, the number of instances from the instance of their fronts to this one; else `None`.
    pub back_of: Option<usize>,
}

impl Scene {
    /// Returns the corner positions of a triangle, metres.
    #[must_use]
    pub fn corners(&self, triangle: TriangleId) -> [Vec3; 3] {
        self.triangles[triangle.index()].vertices.map(|v| self.vertices[v as usize].position)
    }

    /// Returns the material of a triangle.
    #[must_use]
    pub fn material_of(&self, triangle: TriangleId) -> &Material {
        &self.materials[self.triangles[triangle.index()].material.index()]
    }

    /// Returns the optical properties of the surface at the point of a triangle with barycentric coordinates `weights`.
    #[must_use]
    pub fn surface_at(&self, triangle: TriangleId, weights: Vec3) -> SurfacePoint {
        let corners = self.triangles[triangle.index()].vertices.map(|v| &self.vertices[v as usize]);
        let (uv, colour) = Vertex::uv_and_colour_at(corners, weights);
        self.material_of(triangle).at(&self.textures, uv, colour)
    }

    /// Returns the smallest box that holds all vertices; the unit cube if there are none.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        let positions = self.vertices.iter().map(|vertex| vertex.position);
        Bounds::around(positions).unwrap_or(Bounds { low: Vec3::ZERO, high: Vec3::ONE })
    }

    /// Returns the triangles that are not backs, so that every surface occurs once.
    pub fn fronts(&self) -> impl Iterator<Item = TriangleId> + '_ {
        (0..self.triangles.len()).map(TriangleId::new).filter(|&triangle| !self.sides.is_back(triangle))
    }

    /// Returns the triangle that stores the light of the front or back side of `front`, and the barycentric coordinates
    /// in that triangle of the point whose coordinates in `front` are `weights`.
    #[must_use]
    pub fn on_side(&self, front: TriangleId, weights: Vec3, is_front: bool) -> (TriangleId, Vec3) {
        match self.sides.back_of(front) {
            Some(back) if !is_front => (back.triangle, back.weights(weights)),
            _ => (front, weights),
        }
    }

    /// Returns the sum of all triangle areas, square metres.
    #[must_use]
    pub fn area(&self) -> f64 {
        (0..self.triangles.len()).map(|t| f64::from(area_of(self.corners(TriangleId::new(t))))).sum()
    }
}
