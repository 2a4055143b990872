//! Light that mirrors and panes throw on diffuse surfaces, and what comes of it: what the first pass leaves out.
//!
//! Radiosity is solved anew for this light alone, with form factors that are extended by mirrors: rays from each element go
//! on through mirrors and panes to the diffuse surface that these show.
//!
//! Equation: X = T rho X + M rho E - G E + lamps by way of mirrors and panes, where E is the stored irradiance, M takes rays
//! that met a mirror or a pane, T all, and G undoes what radiosity, to which panes are paint, had them reflect.
//!
//! Sources: Wallace, Cohen, Greenberg 1987, "A Two-pass Solution to the Rendering Equation"; Sillion and Puech 1989, "A
//! General Two-Pass Method Integrating Specular and Diffuse Reflection" (extended form factors).

use glam::Vec3;
use rayon::prelude::*;

use super::mirrors::follow;
use super::path::{Chance, PathTracer, Ray};
use super::photons::flux_by_mirrors;
use super::sampler::Sampler;
use super::stored::StoredLight;
use crate::base::ids::TriangleId;
use crate::base::progress::{Progress, Stage};
use crate::base::sampling::{cosine_hemisphere, triangle_from_square};
use crate::base::triangle::interpolate;
use crate::scene::{Scene, area_of, normal_of};

/// Extended form factors that are kept.
const MOST_FACTORS: usize = 1 << 22;

/// Fewest and most rays an element.
const NUM_RAYS: [usize; 2] = [4, 128];

/// Rays that a stored value should rest on; where an element has fewer, its neighbours' count too.
const SMOOTH_RAYS: usize = 256;

/// Passes over all form factors after which solving ends in any case.
const MOST_PASSES: u32 = 64;

/// Solving ends where a pass changes no element by more than this share of the mean.
const TOLERANCE: f32 = 1e-3;

/// Irradiance that the bake does not know, at its vertices `[v]`, lux per channel.
pub(super) struct ThrownLight {
    /// Straight from lights, through panes.
    pub through_panes: Vec<Vec3>,
    /// From lights, by way of mirrors.
    pub by_mirrors: Vec<Vec3>,
    /// All other.
    pub reflected: Vec<Vec3>,
}

/// What an element receives.
struct Element {
    /// Straight from lights, through panes.
    through_panes: Vec3,
    /// What mirrors and panes show it of the stored light, less what that has panes reflect as paint.
    stored: Vec3,
    /// Sides of triangles that it sees, with what of their irradiance it receives.
    factors: Vec<(u32, Vec3)>,
}

/// There is metal or glass in the scene.
pub(super) fn has_mirrors(scene: &Scene) -> bool {
    scene.materials.iter().any(|material| !material.unlit && (material.metallic > 0.0 || material.transmission > 0.0))
}

/// Solves the light that mirrors and panes throw. None where it was cancelled.
pub(super) fn thrown_light(
    rays: &PathTracer<'_>,
    stored: &StoredLight<'_>,
    progress: &dyn Progress,
) -> Option<ThrownLight> {
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
    Some(ThrownLight {
        through_panes: stored(through_panes),
        by_mirrors: stored(by_mirrors),
        reflected: stored(reflected),
    })
}

/// Looks round from every element.
fn elements(
    rays: &PathTracer<'_>,
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
    /// What `num_rays` rays from points of a triangle find, cosine-distributed about its front.
    fn seen_from(rays: &PathTracer<'_>, stored: &StoredLight<'_>, triangle: TriangleId, num_rays: u32) -> Self {
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
            let ray = Ray { origin, direction: cosine_hemisphere(normal, sampler.square()), chance: Chance::Only };
            follow(
                rays,
                ray,
                &mut sampler,
                |_| {},
                |surface, trail, _| {
                    if trail.num_mirrors == 0 && surface.unclear_reflectance != Vec3::ZERO {
                        element.stored -= share * surface.unclear_reflectance * stored.total(surface);
                    }
                    let factor = share * trail.throughput * surface.reflectance;
                    if factor == Vec3::ZERO {
                        return;
                    }
                    element.factors.push((stored.side(surface.triangle, surface.is_front).0, factor));
                    if trail.num_mirrors > 0 {
                        element.stored += factor * stored.total(surface);
                    }
                },
            );
        }
        element.factors.shrink_to_fit();
        element
    }
}

/// Irradiance by reflection `[t]` where `from_lamps` arrives from lamps: gathered pass by pass.
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

/// Values of triangles at their vertices, spread over neighbours `num_times`; no light is lost.
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

/// Means over the triangles round each vertex, by area, so that no light is lost.
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
