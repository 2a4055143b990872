//! Vertices and triangles of a scene, and the geometry of three corners.

use glam::{Vec2, Vec3, Vec4};

use crate::base::ids::{InstanceId, MaterialId};
use crate::base::triangle::interpolate;

/// A vertex in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Position, metres.
    pub position: Vec3,
    /// Unit shading normal.
    pub normal: Vec3,
    /// Texture coordinate sets 0 and 1; (0, 0) if the file has none.
    pub uv: [Vec2; 2],
    /// Linear vertex colour COLOR_0; white if the file has none.
    pub colour: Vec4,
}

impl Vertex {
    /// Returns a white vertex without texture coordinates.
    #[must_use]
    pub fn new(position: Vec3, normal: Vec3) -> Self {
        Self { position, normal, uv: [Vec2::ZERO; 2], colour: Vec4::ONE }
    }

    /// Returns the texture coordinate sets and colour at the point of a triangle with barycentric coordinates
    /// `weights`.
    #[must_use]
    pub fn uv_and_colour_at([a, b, c]: [&Self; 3], weights: Vec3) -> ([Vec2; 2], Vec4) {
        let uv = [0, 1].map(|set| interpolate([a.uv[set], b.uv[set], c.uv[set]], weights));
        (uv, interpolate([a.colour, b.colour, c.colour], weights))
    }
}

/// A triangle of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triangle {
    /// Indices of its vertices, counter-clockwise seen from the front.
    pub vertices: [u32; 3],
    /// Its material.
    pub material: MaterialId,
    /// The instance that it belongs to.
    pub instance: InstanceId,
}

/// Returns the cross product of two edges: it points along the front normal, and its length is twice the area.
#[must_use]
pub fn edge_cross(corners: [Vec3; 3]) -> Vec3 {
    (corners[1] - corners[0]).cross(corners[2] - corners[0])
}

/// Returns the area of a triangle.
#[must_use]
pub fn area_of(corners: [Vec3; 3]) -> f32 {
    0.5 * edge_cross(corners).length()
}

/// Returns the unit normal of the front face; zero if the triangle is degenerate.
#[must_use]
pub fn normal_of(corners: [Vec3; 3]) -> Vec3 {
    edge_cross(corners).normalize_or_zero()
}

/// Returns true if the triangle has no usable area: its height is tiny compared with its longest edge.
#[must_use]
pub(crate) fn is_degenerate(corners: [Vec3; 3]) -> bool {
    /// Height, as a share of the longest edge, below which a triangle is degenerate.
    const SHARE: f32 = 1e-7;
    let [a, b, c] = corners;
    let longest_squared = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
    let area = edge_cross(corners).length();
    area <= SHARE * longest_squared || normal_of(corners) == Vec3::ZERO
}

/// Returns true if a position is plausible: finite, and no coordinate beyond a million kilometres.
#[must_use]
pub(crate) fn is_placeable(position: Vec3) -> bool {
    const LARGEST: f32 = 1e9;
    position.is_finite() && position.abs().max_element() <= LARGEST
}
