//! The triangles of shadow volumes: sides at the outline of the casters, and caps.
//!
//! A side at an edge (a, b) is the quadrilateral a, b, b', a', where v' is v moved away from the light L to infinity:
//! v' = (v w - L, 0) for a homogeneous light (L, w). The signed count of an edge states how often and in which
//! direction it has a side (see [`silhouette`](super::silhouette)). For depth-fail, caps close each volume at its
//! triangle and at infinity.

use glam::{Vec3, Vec4};
use rayon::prelude::*;

use super::silhouette::count;
use crate::render::shadow::shared::casters::{Caster, Casters, Edge};

/// Number of edges in one parallel task.
const CHUNK: usize = 4096;

/// The sides of shadow volumes that are counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Counting {
    /// Sides in front of the visible point (z-pass). Needs sides only.
    DepthPass,
    /// Sides behind the visible point (z-fail). Needs sides and both caps.
    DepthFail,
}

/// The shadow volumes of one light, as triangles. Index 2 v is corner v at its own position, and index 2 v + 1 is
/// corner v moved away from the light to infinity.
///
/// Sides list the corners of their edge in the same order for both windings, and caps list them in the order of their
/// triangle. So triangles that coincide have the same depth to the last bit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hull {
    /// Triangles that are counter-clockwise seen from outside the volume.
    pub counter_clockwise: Vec<u32>,
    /// Triangles that are clockwise seen from outside the volume.
    pub clockwise: Vec<u32>,
}

/// Returns the shadow volumes of the triangles from a light at the homogeneous `position`; a `facing` of 0
/// leaves a triangle out.
#[must_use]
pub fn hull(casters: &Casters, facing: &[i32], position: Vec4, counting: Counting) -> Hull {
    let is_directional = position.w == 0.0;
    let of_edges = |edges: &[Edge]| {
        let mut hull = Hull::default();
        for edge in edges {
            hull.add_side(edge.ends, count(casters, edge, facing), is_directional);
        }
        hull
    };
    let mut hull = Hull::default();
    for part in casters.edges.par_chunks(CHUNK).map(of_edges).collect::<Vec<_>>() {
        hull.append(&part);
    }
    if counting == Counting::DepthFail {
        for (triangle, &facing) in casters.triangles.iter().zip(facing) {
            hull.add_light_caps(casters, triangle, facing);
            hull.add_dark_caps(casters, triangle, facing, is_directional);
        }
    }
    hull
}

/// Returns one closed volume for each triangle. This is slow, but correct by construction.
#[must_use]
pub fn hull_triangle_by_triangle(casters: &Casters, facing: &[i32], position: Vec4) -> Hull {
    let is_directional = position.w == 0.0;
    let mut hull = Hull::default();
    for (triangle, &facing) in casters.triangles.iter().zip(facing) {
        hull.add_light_caps(casters, triangle, facing);
        hull.add_dark_caps(casters, triangle, facing, is_directional);
        for &[a, b, c] in casters.parts(triangle) {
            for [from, to] in [[a, b], [b, c], [c, a]] {
                let direction = if from < to { 1 } else { -1 };
                hull.add_side([from.min(to), from.max(to)], direction * facing, is_directional);
            }
        }
    }
    hull
}

/// Returns the triangles at the terminator of smooth surfaces: on the side that faces away from the light, a
/// shading normal still faces it. `counter_clockwise` lists those whose front is dark, `clockwise` those whose back is.
///
/// Sides of volumes run so close to these triangles that depth cannot distinguish them. So they are darkened
/// explicitly.
#[must_use]
pub fn terminator(casters: &Casters, facing: &[i32], position: Vec4) -> Hull {
    let mut hull = Hull::default();
    for (triangle, &facing) in casters.triangles.iter().zip(facing).filter(|(_, facing)| **facing != 0) {
        let to_light = casters.corners(triangle).map(|corner| position.truncate() - position.w * corner);
        // An interpolated normal can face an interpolated direction only if the normal of some corner faces the
        // direction at some corner, not necessarily the same one.
        let faces_light =
            |&normal: &Vec3| to_light.iter().any(|&to_light| (normal.dot(to_light) < 0.0) == (facing > 0));
        if triangle.normals.iter().any(faces_light) {
            hull.list(-facing).extend(triangle.corners.map(near));
        }
    }
    hull
}

impl Hull {
    /// Adds the side at an edge |count| times; the sign of `count` selects the winding.
    fn add_side(&mut self, [a, b]: [u32; 2], count: i32, is_directional: bool) {
        let list = self.list(count);
        for _ in 0..count.unsigned_abs() {
            list.extend([near(a), far(a), near(b)]);
            // Under a directional light all corners move to the same point at infinity, so a side is one triangle.
            if !is_directional {
                list.extend([far(a), far(b), near(b)]);
            }
        }
    }

    /// Adds the caps that close the volume of a triangle towards the light: the triangle and its slivers
    /// ([`Casters::parts`]).
    pub fn add_light_caps(&mut self, casters: &Casters, triangle: &Caster, facing: i32) {
        if facing != 0 {
            self.list(facing).extend(casters.parts(triangle).iter().flatten().map(|&corner| near(corner)));
        }
    }

    /// Adds the caps that close the volume of a triangle at infinity.
    fn add_dark_caps(&mut self, casters: &Casters, triangle: &Caster, facing: i32, is_directional: bool) {
        if facing != 0 && !is_directional {
            self.list(-facing).extend(casters.parts(triangle).iter().flatten().map(|&corner| far(corner)));
        }
    }

    fn append(&mut self, other: &Hull) {
        self.counter_clockwise.extend_from_slice(&other.counter_clockwise);
        self.clockwise.extend_from_slice(&other.clockwise);
    }

    fn list(&mut self, sign: i32) -> &mut Vec<u32> {
        if sign > 0 { &mut self.counter_clockwise } else { &mut self.clockwise }
    }
}

/// Returns the index of a corner at its own position.
fn near(corner: u32) -> u32 {
    2 * corner
}

/// Returns the index of a corner moved away from the light to infinity.
fn far(corner: u32) -> u32 {
    2 * corner + 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::shadow::volume::silhouette::facing;
    use crate::scene::{Material, SceneBuilder};

    #[test]
    fn corners_in_the_middle_of_an_edge_cut_its_side() {
        let mut builder = SceneBuilder::default();
        let material = builder.material(Material::default());
        let floor = [(-4.0, 4.0), (4.0, 4.0), (4.0, -4.0), (-4.0, -4.0)].map(|(x, z)| Vec3::new(x, 0.0, z));
        builder.quad(floor, material);
        // One quad beside seven that share its edge, in a tilted plane where nothing is exact.
        let (u, v) = (Vec3::new(1.3, 0.17, 0.29), Vec3::new(-0.23, 0.31, -1.1));
        let origin = Vec3::new(-1.0, 1.7, 0.6);
        builder.quad([origin, origin + u, origin + u + v, origin + v], material);
        let near: Vec<Vec3> = (0..=7).map(|i| origin + u + v * (i as f32 / 7.0)).collect();
        let far: Vec<Vec3> = near.iter().map(|&corner| corner + u).collect();
        for i in 0..7 {
            builder.quad([near[i], far[i], far[i + 1], near[i + 1]], material);
        }
        let casters = Casters::new(&builder.build());
        let light = Vec4::new(0.7, 4.0, 0.4, 1.0);
        let hull = hull(&casters, &facing(&casters, light), light, Counting::DepthPass);
        let sides = (hull.counter_clockwise.len() + hull.clockwise.len()) / 6;
        assert_eq!(sides, 4 + 3 + 7 + 2, "sides of the floor and of the outline");
    }
}
