//! Pieces of mesh that are transformed and joined before they become instances of a scene.

use glam::{Quat, Vec2, Vec3};

use crate::scene::Vertex;

/// A piece of mesh with outward, counter-clockwise faces.
#[derive(Clone, Default)]
pub(super) struct Shape {
    pub(super) vertices: Vec<Vertex>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// The sides of an axis-parallel box, in the order of [`Side::ALL`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Side {
    /// Towards -X.
    West,
    /// Towards +X.
    East,
    /// Towards -Y.
    Below,
    /// Towards +Y.
    Above,
    /// Towards -Z.
    North,
    /// Towards +Z.
    South,
}

impl Side {
    /// Every side.
    pub(super) const ALL: [Side; 6] = [Side::West, Side::East, Side::Below, Side::Above, Side::North, Side::South];

    /// Returns the axis of its normal, and true if the normal points in the positive direction.
    pub(super) fn axis(self) -> (usize, bool) {
        (self as usize / 2, self as usize % 2 == 1)
    }
}

/// Returns a planar convex polygon with corners counter-clockwise as seen from the front.
pub(super) fn polygon(corners: &[Vec3]) -> Shape {
    // Newell's formula gives all triangles of the polygon the same normal.
    let around = (0..corners.len()).map(|i| corners[i].cross(corners[(i + 1) % corners.len()]));
    let normal = around.sum::<Vec3>().normalize();
    let vertices = corners.iter().map(|&corner| Vertex::new(corner, normal)).collect();
    let triangles = (1..corners.len() as u32 - 1).map(|i| [0, i, i + 1]).collect();
    Shape { vertices, triangles }
}

/// Returns the corners of one side of a box, counter-clockwise as seen from outside.
pub(super) fn side_corners(low: Vec3, high: Vec3, side: Side) -> [Vec3; 4] {
    let (axis, is_positive) = side.axis();
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let corner = |at_u: Vec3, at_v: Vec3| {
        let mut corner = if is_positive { high } else { low };
        corner[u] = at_u[u];
        corner[v] = at_v[v];
        corner
    };
    let corners = [corner(low, low), corner(high, low), corner(high, high), corner(low, high)];
    if is_positive { corners } else { [corners[0], corners[3], corners[2], corners[1]] }
}

/// Returns an axis-parallel box without the sides in `open`.
pub(super) fn cuboid(low: Vec3, high: Vec3, open: &[Side]) -> Shape {
    let sides = Side::ALL.into_iter().filter(|side| !open.contains(side));
    sides.map(|side| polygon(&side_corners(low, high, side))).collect()
}

impl FromIterator<Shape> for Shape {
    fn from_iter<I: IntoIterator<Item = Shape>>(shapes: I) -> Self {
        shapes.into_iter().fold(Shape::default(), Shape::join)
    }
}

impl Shape {
    /// Returns the union of the vertices and triangles of two shapes.
    pub(super) fn join(mut self, other: Shape) -> Self {
        let first = self.vertices.len() as u32;
        self.vertices.extend(other.vertices);
        self.triangles.extend(other.triangles.into_iter().map(|corners| corners.map(|v| first + v)));
        self
    }

    /// Returns the shape shifted by `offset` metres.
    pub(super) fn moved(mut self, offset: Vec3) -> Self {
        self.vertices.iter_mut().for_each(|vertex| vertex.position += offset);
        self
    }

    /// Returns the shape rotated about the origin.
    pub(super) fn turned(mut self, rotation: Quat) -> Self {
        for vertex in &mut self.vertices {
            vertex.position = rotation * vertex.position;
            vertex.normal = (rotation * vertex.normal).normalize();
        }
        self
    }

    /// Returns the shape rotated counter-clockwise about +Y, as seen from above, by a multiple of 90 degrees, without
    /// rounding.
    pub(super) fn quarter_turned(mut self, times: usize) -> Self {
        for _ in 0..times {
            for vertex in &mut self.vertices {
                let quarter = |v: Vec3| Vec3::new(v.z, v.y, 0.0 - v.x);
                vertex.position = quarter(vertex.position);
                vertex.normal = quarter(vertex.normal);
            }
        }
        self
    }

    /// Returns the shape with its front and back faces exchanged.
    pub(super) fn inside_out(mut self) -> Self {
        self.vertices.iter_mut().for_each(|vertex| vertex.normal = -vertex.normal);
        self.triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
        self
    }

    /// Returns the shape with texture coordinates as a function of position.
    pub(super) fn with_uv(mut self, uv: impl Fn(Vec3) -> Vec2) -> Self {
        self.vertices.iter_mut().for_each(|vertex| vertex.uv[0] = uv(vertex.position));
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::normal_of;

    #[test]
    fn every_side_of_a_box_faces_outward() {
        let (low, high) = (Vec3::new(-1.0, 2.0, 3.0), Vec3::new(1.0, 3.0, 5.0));
        for side in Side::ALL {
            let (axis, is_positive) = side.axis();
            let shape = polygon(&side_corners(low, high, side));
            let mut outward = Vec3::ZERO;
            outward[axis] = if is_positive { 1.0 } else { -1.0 };
            for triangle in &shape.triangles {
                let normal = normal_of(triangle.map(|v| shape.vertices[v as usize].position));
                assert_eq!(normal, outward, "{side:?}");
            }
            assert_eq!(shape.vertices[0].normal, outward);
        }
    }

    #[test]
    fn four_quarter_turns_change_nothing() {
        let corners = [Vec3::ZERO, Vec3::new(0.1, 0.0, 0.0), Vec3::new(0.1, 0.7, 0.3)];
        let turned = polygon(&corners).quarter_turned(4);
        assert_eq!(turned.vertices.iter().map(|v| v.position).collect::<Vec<_>>(), corners);
        let east = polygon(&corners).moved(Vec3::Z).quarter_turned(1);
        assert_eq!(east.vertices[0].position, Vec3::X, "south becomes east");
    }
}
