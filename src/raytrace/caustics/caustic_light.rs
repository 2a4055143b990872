//! Caustics and their interreflection: the irradiance that the first pass lacks, solved for all elements.
//!
//! Radiosity is solved for this light alone, with form factors that are extended by mirrors: rays from each element are
//! followed by way of mirrors and panes to diffuse surfaces.
//!
//! Equation: X = T rho X + M rho E - G E + X_lamps, where X is the missing irradiance and E the stored one. T is the
//! share of light that arrives along all rays, M the share along rays that hit a mirror or a pane, and X_lamps the
//! irradiance from lamps by way of mirrors and panes. G subtracts the light that panes reflect in the first pass, which
//! treats them as paint.
//!
//! Sources: Wallace, Cohen, Greenberg 1987, "A Two-pass Solution to the Rendering Equation"; Sillion and Puech 1989, "A
//! General Two-Pass Method Integrating Specular and Diffuse Reflection" (extended form factors).

use glam::Vec3;
use rayon::prelude::*;

use crate::base::ids::TriangleId;
use crate::base::progress::{Progress, Stage};
use crate::base::sampling::{cosine_hemisphere, triangle_from_square};
use crate::base::triangle::interpolate;
use crate::raytrace::caustics::photons::flux_by_mirrors;
use crate::raytrace::path::ray_caster::RayCaster;
use crate::raytrace::path::specular_chain::follow;
use crate::raytrace::ray::{Ray, RaySource};
use crate::raytrace::sampler::Sampler;
use crate::raytrace::stored_light::{CausticLight, StoredLight};
use crate::scene::{Scene, area_of, normal_of};

/// Largest number of extended form factors in memory.
const MOST_FACTORS: usize = 1 << 22;

/// Smallest and largest number of rays from an element.
const NUM_RAYS: [usize; 2] = [4, 128];

/// Number of rays that the value at a vertex should be based on. If elements have fewer, values are averaged over
/// neighbours.
const SMOOTH_RAYS: usize = 256;

/// Largest number of passes over all form factors.
const MOST_PASSES: u32 = 64;

/// Solving ends when a pass changes no element by more than this share of the mean.
const TOLERANCE: f32 = 1e-3;

/// The light that an element receives.
struct Element {
    /// Irradiance straight from lights, through panes.
    through_panes: Vec3,
    /// Stored light by way of mirrors and panes, minus the light that panes reflect as paint in the first pass.
    stored: Vec3,
    /// Sides of triangles in view of the element, each with the share of its irradiance that arrives here.
    factors: Vec<(u32, Vec3)>,
}

/// Returns true if the scene has metal or glass.
pub(crate) fn has_mirrors(scene: &Scene) -> bool {
    scene.materials.iter().any(|material| !material.unlit && (material.metallic > 0.0 || material.transmission > 0.0))
}

/// Solves the light that mirrors and panes cast. Returns `None` if it was cancelled.
pub(crate) fn caustic_light(
    rays: &RayCaster<'_>,
    stored: &StoredLight<'_>,
    progress: &dyn Progress,
) -> Option<CausticLight> {
    let scene = rays.scene();
    let areas: Vec<f32> = (0..scene.triangles.len()).map(|t| area_of(scene.corners(TriangleId::new(t)))).collect();
    let flux = flux_by_mirrors(rays, |triangle, is_front| stored.side(triangle, is_front), progress)?;
    let by_mirrors: Vec<Vec3> = flux.iter().zip(&areas).map(|(&flux, &area)| flux / area).collect();
    let num_rays = (MOST_FACTORS / areas.len().max(1)).clamp(NUM_RAYS[0], NUM_RAYS[1]);
    let elements = elements(rays, stored, num_rays as u32, progress)?;
    let from_lamps: Vec<Vec3> =
        by_mirrors.iter().zip(&elements).map(|(&e, element)| e + element.through_panes).collect();
    let reflected = solved(&elements, &from_lamps);
    let through_panes: Vec<Vec3> = elements.iter().map(|element| element.through_panes).collect();
    let stored = |values: Vec<Vec3>| smoothed(scene, &areas, values, SMOOTH_RAYS / num_rays);
    Some(CausticLight {
        through_panes: stored(through_panes),
        by_mirrors: stored(by_mirrors),
        reflected: stored(reflected),
    })
}

/// Casts rays from every element.
fn elements(
    rays: &RayCaster<'_>,
    stored: &StoredLight<'_>,
    num_rays: u32,
    progress: &dyn Progress,
) -> Option<Vec<Element>> {
    let num_elements = rays.scene().triangles.len();
    let element = |t: usize| {
        if t.is_multiple_of(1024) {
            progress.rest();
            progress.report(Stage::Gather, t as f32 / num_elements as f32);
        }
        (!progress.is_cancelled()).then(|| Element::seen_from(rays, stored, TriangleId::new(t), num_rays))
    };
    (0..num_elements).into_par_iter().with_min_len(64).map(element).collect()
}

impl Element {
    /// Returns the light along `num_rays` rays from points of a triangle, cosine-distributed about its front.
    fn seen_from(rays: &RayCaster<'_>, stored: &StoredLight<'_>, triangle: TriangleId, num_rays: u32) -> Self {
        let corners = rays.scene().corners(triangle);
        let normal = normal_of(corners);
        let mut element = Self { through_panes: Vec3::ZERO, stored: Vec3::ZERO, factors: Vec::new() };
        let share = 1.0 / num_rays as f32;
        for index in 0..num_rays {
            let mut sampler = Sampler::new(triangle.0, index);
            let weights = triangle_from_square(sampler.square());
            let point = interpolate(corners, weights);
            let origin = rays.above(point, normal);
            element.through_panes += share * rays.irradiance_through_panes(origin, normal, &mut sampler);
            let ray =
                Ray { origin, direction: cosine_hemisphere(normal, sampler.square()), source: RaySource::Unshared };
            follow(
                rays,
                ray,
                &mut sampler,
                |_| {},
                |surface, chain, _| {
                    if chain.num_mirrors == 0 && surface.unclear_reflectance != Vec3::ZERO {
                        element.stored -= share * surface.unclear_reflectance * stored.total(surface);
                    }
                    let factor = share * chain.throughput * surface.reflectance;
                    if factor == Vec3::ZERO {
                        return;
                    }
                    element.factors.push((stored.side(surface.triangle, surface.is_front).0, factor));
                    if chain.num_mirrors > 0 {
                        element.stored += factor * stored.total(surface);
                    }
                },
            );
        }
        element.factors.shrink_to_fit();
        element
    }
}

/// Irradiance by reflection `[t]` of `from_lamps`, the irradiance from lamps, by Jacobi iteration.
fn solved(elements: &[Element], from_lamps: &[Vec3]) -> Vec<Vec3> {
    let mut reflected: Vec<Vec3> = elements.iter().map(|element| element.stored).collect();
    for _ in 0..MOST_PASSES {
        let all: Vec<Vec3> = from_lamps.iter().zip(&reflected).map(|(&a, &b)| a + b).collect();
        let gathered: Vec<Vec3> = elements
            .par_iter()
            .map(|element| {
                element.stored + element.factors.iter().map(|&(t, factor)| factor * all[t as usize]).sum::<Vec3>()
            })
            .collect();
        let mean = gathered.iter().sum::<Vec3>() / gathered.len().max(1) as f32;
        let change = gathered.iter().zip(&reflected).map(|(&a, &b)| (a - b).abs().max_element()).fold(0.0, f32::max);
        reflected = gathered;
        if change <= TOLERANCE * mean.max_element() {
            break;
        }
    }
    reflected
}

/// Returns the values of triangles at their vertices, averaged over neighbours `num_times` times. No light is lost.
fn smoothed(scene: &Scene, areas: &[f32], mut values: Vec<Vec3>, num_times: usize) -> Vec<Vec3> {
    let mut found = at_vertices(scene, areas, &values);
    for _ in 0..num_times {
        for (value, triangle) in values.iter_mut().zip(&scene.triangles) {
            *value = triangle.vertices.iter().map(|&v| found[v as usize]).sum::<Vec3>() / 3.0;
        }
        found = at_vertices(scene, areas, &values);
    }
    found
}

/// Means over the triangles round each vertex, weighted by area so that no light is lost.
fn at_vertices(scene: &Scene, areas: &[f32], values: &[Vec3]) -> Vec<Vec3> {
    let mut sums = vec![(Vec3::ZERO, 0.0f32); scene.vertices.len()];
    for (triangle, (&area, &value)) in scene.triangles.iter().zip(areas.iter().zip(values)) {
        for vertex in triangle.vertices {
            let sum = &mut sums[vertex as usize];
            *sum = (sum.0 + area * value, sum.1 + area);
        }
    }
    sums.into_iter().map(|(sum, area)| if area > 0.0 { sum / area } else { Vec3::ZERO }).collect()
}
