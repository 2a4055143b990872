//! Where a light sees casters end: the sides of shadow volumes.
//!
//! Each triangle is taken as if it faced the light. An edge then counts the triangles on it with their direction: inside
//! a surface they cancel, and what is left over says how often, and which way round, the edge is a side of the volume.
//! A point is in shadow where the count of volumes round it, one a triangle between it and the light, is not zero.

use glam::{DVec3, Vec3, Vec4};
use rayon::prelude::*;

use super::casters::{Caster, Casters, Edge};

/// Edges that one task takes.
const CHUNK: usize = 4096;

/// How shadow volumes are counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Counting {
    /// In front of what is seen: needs sides only.
    DepthPass,
    /// Behind what is seen: needs sides and both caps.
    DepthFail,
}

/// The shadow volumes of one light, as triangles. An index is twice the corner, plus 1 where it is infinitely far from
/// the light.
///
/// The sides at an edge list their corners in the same order whichever way round they are, and caps in the order of
/// their triangle: what coincides has the same depth to the last bit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hull {
    /// Triangles that are counter-clockwise seen from outside of the volume.
    pub counter_clockwise: Vec<u32>,
    /// Triangles that are clockwise.
    pub clockwise: Vec<u32>,
}

/// +1 where a triangle's front faces the light, -1 where its back does, `[t]`.
///
/// Computed once a triangle and in double precision: its edges must all agree.
#[must_use]
pub fn facing(casters: &Casters, place: Vec4) -> Vec<i32> {
    let light = place.truncate().as_dvec3();
    let towards = |point: DVec3| light - f64::from(place.w) * point;
    let of = |triangle: &Caster| {
        let [a, b, c] = casters.corners(triangle).map(Vec3::as_dvec3);
        if (b - a).cross(c - a).dot(towards(a)) >= 0.0 { 1 } else { -1 }
    };
    casters.triangles.par_iter().map(of).collect()
}

/// The shadow volumes of those triangles whose `facing` is not zero.
#[must_use]
pub fn hull(casters: &Casters, facing: &[i32], place: Vec4, counting: Counting) -> Hull {
    let is_directional = place.w == 0.0;
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

/// How often, and which way round, an edge is a side of the volumes.
fn count(casters: &Casters, edge: &Edge, facing: &[i32]) -> i32 {
    let sides = &casters.sides[edge.sides.start as usize..edge.sides.end as usize];
    sides.iter().map(|side| side.direction * facing[side.triangle as usize]).sum()
}

/// Ends of the edges at which the light sees casters end.
#[must_use]
pub fn silhouette(casters: &Casters, facing: &[i32]) -> Vec<[u32; 2]> {
    casters.edges.iter().filter(|edge| count(casters, edge, facing) != 0).map(|edge| edge.ends).collect()
}

/// The shadow volumes of all triangles as if no two were joined: each closed in itself. Slow, and right by construction.
#[must_use]
pub fn hull_triangle_by_triangle(casters: &Casters, facing: &[i32], place: Vec4) -> Hull {
    let is_directional = place.w == 0.0;
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

/// Triangles that turn one side to the light while on the other a smooth shading normal sees it. Listed
/// counter-clockwise is what is dark seen from its front, clockwise what is dark seen from its back.
///
/// Sides of volumes run too close to these triangles for depths to tell them apart.
#[must_use]
pub fn terminator(casters: &Casters, facing: &[i32], place: Vec4) -> Hull {
    let mut hull = Hull::default();
    for (triangle, &facing) in casters.triangles.iter().zip(facing).filter(|(_, facing)| **facing != 0) {
        let to_light = casters.corners(triangle).map(|corner| place.truncate() - place.w * corner);
        // Interpolated, normal and direction see one another only if those of some two corners do.
        let sees = |&normal: &Vec3| to_light.iter().any(|&to_light| (normal.dot(to_light) < 0.0) == (facing > 0));
        if triangle.normals.iter().any(sees) {
            hull.list(-facing).extend(triangle.corners.map(near));
        }
    }
    hull
}

impl Hull {
    /// The side at an edge, `count` times; the other way round where that is negative.
    fn add_side(&mut self, [a, b]: [u32; 2], count: i32, is_directional: bool) {
        let list = self.list(count);
        for _ in 0..count.unsigned_abs() {
            list.extend([near(a), far(a), near(b)]);
            // Seen from a directional light, infinity is a point.
            if !is_directional {
                list.extend([far(a), far(b), near(b)]);
            }
        }
    }

    /// Closes the volume of a triangle towards the light.
    pub fn add_light_caps(&mut self, casters: &Casters, triangle: &Caster, facing: i32) {
        if facing != 0 {
            self.list(facing).extend(casters.parts(triangle).iter().flatten().map(|&corner| near(corner)));
        }
    }

    /// Closes the volume of a triangle at infinity.
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

/// Where the corner is.
fn near(corner: u32) -> u32 {
    2 * corner
}

/// Where the light would throw its shadow at infinity.
fn far(corner: u32) -> u32 {
    2 * corner + 1
}
