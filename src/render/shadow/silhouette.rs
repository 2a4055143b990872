//! Where a light sees casters end: the sides of shadow volumes.
//!
//! Each triangle is taken as if it faced the light. An edge then counts the triangles on it with their direction: inside
//! a surface they cancel, and what is left over says how often, and which way round, the edge is a side of the volume.
//! A point is in shadow where the count of volumes round it, one a triangle between it and the light, is not zero.

use glam::{DVec3, Vec3, Vec4};
use rayon::prelude::*;

use super::casters::{Caster, Casters};

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

/// The shadow volumes of one light, as triangles. An index is three times the corner, plus 0 where it is in its
/// place, 1 where it is infinitely far from the light, 2 where it is a hair deeper; all triangles are counter-clockwise seen from outside of the volume, but for `averted_caps`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hull {
    /// Sides, and for depth-fail the caps at infinity.
    pub walls: Vec<u32>,
    /// Caps that face the light with the front of their triangle.
    pub facing_caps: Vec<u32>,
    /// Caps that face the light with the back of their triangle: clockwise, so that their depth is that of the triangle
    /// to the last bit.
    pub averted_caps: Vec<u32>,
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
    let of_edges = |edges: &[super::casters::Edge]| {
        let mut walls = Vec::new();
        for edge in edges {
            let sides = &casters.sides[edge.sides.start as usize..edge.sides.end as usize];
            let count: i32 = sides.iter().map(|side| side.direction * facing[side.triangle as usize]).sum();
            let [a, b] = if count > 0 { edge.ends } else { [edge.ends[1], edge.ends[0]] };
            for _ in 0..count.unsigned_abs() {
                walls.extend([near(a), far(a), near(b)]);
                if !is_directional {
                    walls.extend([far(a), far(b), near(b)]);
                }
            }
        }
        walls
    };
    let mut hull =
        Hull { walls: casters.edges.par_chunks(CHUNK).map(of_edges).collect::<Vec<_>>().concat(), ..Hull::default() };
    if counting == Counting::DepthFail {
        add_caps(&mut hull, casters, facing, is_directional);
    }
    hull
}

/// Closes the volumes at the casters and at infinity; seen from a directional light, infinity is a point.
fn add_caps(hull: &mut Hull, casters: &Casters, facing: &[i32], is_directional: bool) {
    for (triangle, &facing) in casters.triangles.iter().zip(facing).filter(|(_, facing)| **facing != 0) {
        hull.add_light_caps(casters, triangle, facing);
        for &[a, b, c] in parts(casters, triangle).iter().filter(|_| !is_directional) {
            hull.walls.extend(if facing > 0 { [far(a), far(c), far(b)] } else { [far(a), far(b), far(c)] });
        }
    }
}

impl Hull {
    /// Closes the volume of a triangle towards the light.
    pub fn add_light_caps(&mut self, casters: &Casters, triangle: &Caster, facing: i32) {
        let caps = if facing > 0 { &mut self.facing_caps } else { &mut self.averted_caps };
        let (whole, slivers) = parts(casters, triangle).split_first().expect("a triangle is its own first part");
        caps.extend(whole.iter().map(|&corner| near(corner)));
        caps.extend(slivers.iter().flatten().map(|&corner| behind(corner)));
    }
}

/// The shadow volumes of all triangles as if no two were joined: each closed in itself. Slow, and right by construction.
#[must_use]
pub fn hull_triangle_by_triangle(casters: &Casters, facing: &[i32], place: Vec4) -> Hull {
    let mut hull = Hull::default();
    for (triangle, &facing) in casters.triangles.iter().zip(facing) {
        hull.add_light_caps(casters, triangle, facing);
        for &part in parts(casters, triangle) {
            let [a, b, c] = if facing > 0 { part } else { [part[0], part[2], part[1]] };
            for [from, to] in [[a, b], [b, c], [c, a]] {
                hull.walls.extend([near(from), far(from), near(to)]);
                hull.walls.extend([far(from), far(to), near(to)]);
            }
            if place.w != 0.0 {
                hull.walls.extend([far(a), far(c), far(b)]);
            }
        }
    }
    hull
}

fn parts<'a>(casters: &'a Casters, triangle: &Caster) -> &'a [[u32; 3]] {
    &casters.parts[triangle.parts.start as usize..triangle.parts.end as usize]
}

/// Where the corner is.
fn near(corner: u32) -> u32 {
    3 * corner
}

/// Where the light would throw its shadow at infinity.
fn far(corner: u32) -> u32 {
    3 * corner + 1
}

/// In the same place of the picture a hair deeper: slivers have no depth of their own to trust, and must not hide behind
/// the triangles between which they lie.
fn behind(corner: u32) -> u32 {
    3 * corner + 2
}
