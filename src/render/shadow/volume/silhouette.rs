//! Signed edge counts: determine which edges are the outline of the casters, seen from a light.
//!
//! Each triangle t is oriented so that it faces the light: f_t = +1 if its front does, -1 if its back does. The order
//! of its corners passes an edge e from the lower to the higher index (d = +1) or back (d = -1). The count of the edge
//! is the sum over its triangles (Kim, Kim and Turk 2008, "A shadow-volume algorithm for opaque and transparent
//! nonmanifold casters"):
//!
//! ```text
//! c_e = sum over the triangles t at e of  d_{t,e} f_t
//! ```
//!
//! At an edge within a surface, the terms of its two triangles cancel. At a silhouette they add up to +-2. At the
//! border of an open mesh, the term of the only triangle is +-1. The sign is the direction of the volume's side at this
//! edge, and the absolute value is the number of times it is drawn.

use glam::{DVec3, Vec3, Vec4};
use rayon::prelude::*;

use crate::render::shadow::shared::casters::{Caster, Casters, Edge};

/// Returns for each triangle `[t]` +1 if its front faces a light at the homogeneous `position`, -1 if its back does.
///
/// The value is computed once for a triangle and in double precision, because all edges of the triangle must agree.
#[must_use]
pub fn facing(casters: &Casters, position: Vec4) -> Vec<i32> {
    let light = position.truncate().as_dvec3();
    let towards = |point: DVec3| light - f64::from(position.w) * point;
    let of = |triangle: &Caster| {
        let [a, b, c] = casters.corners(triangle).map(Vec3::as_dvec3);
        if (b - a).cross(c - a).dot(towards(a)) >= 0.0 { 1 } else { -1 }
    };
    casters.triangles.par_iter().map(of).collect()
}

/// Returns the signed count of an edge: its absolute value is the number of sides at the edge, its
/// sign their direction.
pub fn count(casters: &Casters, edge: &Edge, facing: &[i32]) -> i32 {
    let sides = &casters.sides[edge.sides.start as usize..edge.sides.end as usize];
    sides.iter().map(|side| side.direction * facing[side.triangle as usize]).sum()
}

/// Returns the ends of all edges whose count is not zero: the outline of the casters, seen from the light.
#[must_use]
pub fn silhouette(casters: &Casters, facing: &[i32]) -> Vec<[u32; 2]> {
    casters.edges.iter().filter(|edge| count(casters, edge, facing) != 0).map(|edge| edge.ends).collect()
}

#[cfg(test)]
mod tests {
    use glam::Quat;

    use super::*;
    use crate::scene::{Material, SceneBuilder};

    #[test]
    fn a_light_above_sees_the_outline_of_floor_and_cube() {
        let mut builder = SceneBuilder::default();
        let material = builder.material(Material::default());
        let floor = [(-4.0, 4.0), (4.0, 4.0), (4.0, -4.0), (-4.0, -4.0)].map(|(x, z)| Vec3::new(x, 0.0, z));
        builder.quad(floor, material).block(Vec3::new(0.0, 1.2, 0.0), Vec3::splat(0.5), Quat::IDENTITY, material);
        let casters = Casters::new(&builder.build());
        let edges = silhouette(&casters, &facing(&casters, Vec4::new(0.0, 4.0, 0.0, 1.0)));
        assert_eq!(edges.len(), 8, "four of the floor, four of the cube's top");
        assert!(edges.iter().flatten().all(|&corner| [0.0, 1.7].contains(&casters.positions[corner as usize].y)));
    }
}
