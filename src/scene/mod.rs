//! Floor 1: the scene as the rest of the program sees it: world-space triangles, materials, lights, cameras.
//!
//! A [`Scene`] is validated when it is made ([`gltf::load`]): all numbers are finite and all indices in range, so no
//! later stage checks again. Deliberately absent: work with the node tree (transforms are applied on loading; it is kept for
//! bakes) and anything of the GPU.

pub mod builtin;
pub mod camera;
pub mod chunks;
pub mod doctor;
pub mod gltf;
pub mod light;
pub mod material;
pub mod node;
pub mod photometry;

use std::ops::Range;

use glam::{Vec2, Vec3, Vec4};

pub use camera::{Camera, Projection};
pub use light::{Arrival, Light, LightKind};
pub use material::{AlphaMode, Image, MAX_REFLECTANCE, Material, Sampler, SurfacePoint, Texture, TextureSlot, Wrap};
pub use node::{NamedNode, Transform};
pub use photometry::Profile;

use crate::base::ids::{InstanceId, MaterialId, TriangleId};

/// A scene ready to be lit: everything in world space, metres, +Y up, counter-clockwise front faces.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// File stem, or the name of a built-in scene.
    pub name: String,
    /// Vertices `[v]`, as the file splits them (at seams of normals and texture coordinates).
    pub vertices: Vec<Vertex>,
    /// Triangles `[t]`, those of one instance side by side.
    pub triangles: Vec<Triangle>,
    /// Placed primitives `[i]`.
    pub instances: Vec<Instance>,
    /// The file's tree of nodes, parents first; empty where there is none.
    pub nodes: Vec<NamedNode>,
    /// Materials `[m]`.
    pub materials: Vec<Material>,
    /// Textures that material slots name.
    pub textures: Vec<Texture>,
    /// Punctual lights.
    pub lights: Vec<Light>,
    /// Cameras in file order.
    pub cameras: Vec<Camera>,
    /// Names of the light groups `[g]`; lights and emissive materials say which group is theirs.
    pub light_groups: Vec<String>,
    /// Stored light found in the file: vertex attributes whose name begins with `_IRRADIANCE_`, one value a vertex.
    pub irradiance: Vec<VertexAttribute>,
    /// Names of the file's material variants, one of which may have been chosen on loading.
    pub variants: Vec<String>,
    /// Triangles of the file that have no area and were left out.
    pub dropped_triangles: usize,
    /// What the loader noticed and the user should know, one line each.
    pub notes: Vec<String>,
}

/// A vertex in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Metres.
    pub position: Vec3,
    /// Unit shading normal.
    pub normal: Vec3,
    /// Texture coordinate sets 0 and 1; (0, 0) where absent.
    pub uv: [Vec2; 2],
    /// Linear COLOR_0; white where absent.
    pub colour: Vec4,
}

/// A triangle of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triangle {
    /// Indices of its vertices, counter-clockwise seen from the front.
    pub vertices: [u32; 3],
    /// What it is made of.
    pub material: MaterialId,
    /// Where it comes from.
    pub instance: InstanceId,
    /// It is the back of a double-sided triangle, written out by a bake; rays see only the front twin.
    pub is_back_side: bool,
}

/// A placed mesh primitive.
#[derive(Clone, Debug, Default)]
pub struct Instance {
    /// Name of the node, or of its mesh where the node has none.
    pub name: String,
    /// Its triangles.
    pub triangles: Range<usize>,
}

/// One vector a vertex under a glTF attribute name.
#[derive(Clone, Debug, PartialEq)]
pub struct VertexAttribute {
    /// Name as in the file.
    pub name: String,
    /// Values `[v]`.
    pub values: Vec<Vec3>,
}

impl Scene {
    /// Corner positions of a triangle, metres.
    #[must_use]
    pub fn corners(&self, triangle: TriangleId) -> [Vec3; 3] {
        self.triangles[triangle.index()].vertices.map(|v| self.vertices[v as usize].position)
    }

    /// Material of a triangle.
    #[must_use]
    pub fn material_of(&self, triangle: TriangleId) -> &Material {
        &self.materials[self.triangles[triangle.index()].material.index()]
    }

    /// What the surface is at a point of a triangle, given by the weights of its corners.
    #[must_use]
    pub fn surface_at(&self, triangle: TriangleId, weights: Vec3) -> SurfacePoint {
        let corners = self.triangles[triangle.index()].vertices.map(|v| &self.vertices[v as usize]);
        let [a, b, c] = corners;
        let uv = [0, 1].map(|set| a.uv[set] * weights.x + b.uv[set] * weights.y + c.uv[set] * weights.z);
        let colour = a.colour * weights.x + b.colour * weights.y + c.colour * weights.z;
        self.material_of(triangle).at(&self.textures, uv, colour)
    }

    /// Smallest box round all vertices, or a unit box where there are none.
    #[must_use]
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let mut positions = self.vertices.iter().map(|v| v.position);
        let Some(first) = positions.next() else {
            return (Vec3::ZERO, Vec3::ONE);
        };
        positions.fold((first, first), |(low, high), p| (low.min(p), high.max(p)))
    }

    /// Sum of all triangle areas, square metres.
    #[must_use]
    pub fn area(&self) -> f64 {
        (0..self.triangles.len()).map(|t| f64::from(area_of(self.corners(TriangleId::new(t))))).sum()
    }
}

/// Cross product of two edges: twice the area in length, along the front normal.
#[must_use]
pub fn edge_cross(corners: [Vec3; 3]) -> Vec3 {
    (corners[1] - corners[0]).cross(corners[2] - corners[0])
}

/// Area of a triangle.
#[must_use]
pub fn area_of(corners: [Vec3; 3]) -> f32 {
    0.5 * edge_cross(corners).length()
}

/// Unit normal of the front face; zero for a degenerate triangle.
#[must_use]
pub fn normal_of(corners: [Vec3; 3]) -> Vec3 {
    edge_cross(corners).normalize_or_zero()
}

/// It has no area to speak of: its height is rounding beside its longest edge.
#[must_use]
pub fn is_degenerate(corners: [Vec3; 3]) -> bool {
    /// Share of the longest edge below which a height is none.
    const SHARE: f32 = 1e-7;
    let [a, b, c] = corners;
    let longest_squared = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
    let area = edge_cross(corners).length();
    area <= SHARE * longest_squared || normal_of(corners) == Vec3::ZERO
}

/// It is a place that may be meant: finite, and not beyond a million kilometres.
#[must_use]
pub fn is_placeable(position: Vec3) -> bool {
    const LARGEST: f32 = 1e9;
    position.is_finite() && position.abs().max_element() <= LARGEST
}
