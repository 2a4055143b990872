//! The elements at their places in the texture.

use glam::{DVec2, DVec3, Vec3};

use super::layout::Layout;
use crate::baked::VertexLight;
use crate::base::ids::TriangleId;
use crate::patch::{Element, PatchMesh};

/// An element in the texture.
pub(super) struct Piece {
    /// Corners in the texture, texels.
    pub corners: [DVec2; 3],
    /// Irradiance at the corners, lux per channel.
    pub light: [Vec3; 3],
    /// Area of the surface, square metres, holes included.
    pub area: f64,
}

/// All elements in the texture.
pub(super) fn pieces<'a>(
    layout: &'a Layout,
    mesh: &'a PatchMesh,
    light: &'a VertexLight,
) -> impl Iterator<Item = Piece> + 'a {
    let irradiance = move |v: u32| -> Vec3 {
        light.groups.iter().map(|group| group.direct[v as usize] + group.indirect[v as usize]).sum()
    };
    (0..layout.sources.len()).flat_map(move |t| {
        let flattening = Flattening::of(layout, t);
        let elements = mesh.elements_of(layout.sources[t], layout.scene.sides.is_back(TriangleId::new(t)));
        elements.iter().map(move |element| Piece {
            corners: flattening.corners(mesh, element),
            light: element.vertices.map(irradiance),
            area: f64::from(crate::scene::area_of(mesh.corners(element))),
        })
    })
}

/// The affine map from the plane of a triangle to the texture.
struct Flattening {
    corner: DVec3,
    edges: [DVec3; 2],
    flat: [DVec2; 3],
}

impl Flattening {
    fn of(layout: &Layout, t: usize) -> Self {
        let [a, b, c] =
            layout.scene.triangles[t].vertices.map(|v| layout.scene.vertices[v as usize].position.as_dvec3());
        Self { corner: a, edges: [b - a, c - a], flat: layout.corners(t) }
    }

    fn corners(&self, mesh: &PatchMesh, element: &Element) -> [DVec2; 3] {
        mesh.corners(element).map(|place| self.at(place.as_dvec3()))
    }

    /// Maps a position by its barycentric coordinates. The normal equations, from which they are computed, project the
    /// position on to the plane of the triangle.
    fn at(&self, place: DVec3) -> DVec2 {
        let ([u, v], d) = (self.edges, place - self.corner);
        let (uu, uv, vv, du, dv) = (u.dot(u), u.dot(v), v.dot(v), d.dot(u), d.dot(v));
        let determinant = uu * vv - uv * uv;
        let (y, z) = ((vv * du - uv * dv) / determinant, (uu * dv - uv * du) / determinant);
        let [a, b, c] = self.flat;
        if determinant > 0.0 { a + (b - a) * y + (c - a) * z } else { a }
    }
}
