//! Direct light on elements. Its reflection is the first power that the solvers distribute.
//!
//! Direct light is sampled at points inside the elements. The vertices are not suitable, because they lie in creases
//! and have smooth normals. Points inside a solid do not count in the mean, so an element of a floor that extends under
//! a wall is as bright as its open part.

use glam::Vec3;
use rayon::prelude::*;

use super::direct_irradiance::DirectLight;
use crate::base::progress::Progress;
use crate::base::sampling::{cosine_hemisphere, r2};
use crate::form_factor::{MAX_BACK_SHARE, Viewpoint};
use crate::patch::PatchMesh;
use crate::radiosity::field::Field;
use crate::radiosity::viewpoints::Viewpoints;
use crate::trace::Tracer;

/// Number of rays that test whether a dark point lies inside a solid.
const NUM_PROBES: u32 = 8;

/// Computes direct irradiance `[e][g]`, lux per channel: the mean over `num_points` points of each element.
#[must_use]
pub fn direct_on_elements(
    mesh: &PatchMesh,
    viewpoints: &Viewpoints,
    lights: &DirectLight<'_>,
    num_points: usize,
    progress: &dyn Progress,
) -> Field {
    let points = viewpoints.on_elements(mesh, num_points);
    let at_points = lights.irradiance(&points, progress);
    let num_groups = at_points.num_groups();
    let mut mean = Field::zero(mesh.elements.len(), num_groups);
    if num_groups == 0 {
        return mean;
    }
    mean.values_mut().par_chunks_mut(num_groups).enumerate().for_each(|(e, sums)| {
        let places = e * num_points..(e + 1) * num_points;
        let is_lit = |place: usize| at_points.total(place) != Vec3::ZERO;
        let num_lit = places.clone().filter(|&place| is_lit(place)).count();
        // If all points are dark, the mean is 0 however many of them are open.
        let num_open = match num_lit {
            0 => num_points,
            _ => {
                num_lit
                    + places.clone().filter(|&p| !is_lit(p) && !is_inside_solid(lights.tracer(), &points[p])).count()
            }
        };
        for place in places {
            for (sum, &value) in sums.iter_mut().zip(at_points.at(place)) {
                *sum += value / num_open as f32;
            }
        }
    });
    mean
}

/// Returns true if the viewpoint lies inside a solid: almost all of its rays hit back faces.
#[must_use]
pub fn is_inside_solid(tracer: &Tracer<'_>, viewpoint: &Viewpoint) -> bool {
    let is_back = |i: &u32| {
        let direction = cosine_hemisphere(viewpoint.normal, r2(*i, viewpoint.seed));
        let hit = tracer.nearest(viewpoint.position, direction, f32::INFINITY);
        hit.is_some_and(|hit| !hit.is_front && !tracer.scene().material_of(hit.triangle).double_sided)
    };
    (0..NUM_PROBES).filter(is_back).count() as f32 > MAX_BACK_SHARE * NUM_PROBES as f32
}
