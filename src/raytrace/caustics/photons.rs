//! Light of lamps by way of mirrors, computed with photons shot from the lamps. Rays from elements seldom find a small
//! lamp in a mirror.
//!
//! A photon starts at a random point of a lamp in a cosine-distributed direction and carries the flux Phi = pi L A / p
//! of the lamp that was chosen with probability p. If the photon lands on a diffuse surface after a reflection, its
//! flux is added to the triangle there; irradiance is flux / area. Only emissive surfaces shoot, because path tracing
//! leaves out punctual lights by way of mirrors as well.
//!
//! Source: Arvo 1986, "Backward Ray Tracing" (light is stored on the surfaces that it lands on).

use glam::Vec3;
use rayon::prelude::*;

use crate::base::ids::TriangleId;
use crate::base::progress::Progress;
use crate::raytrace::path::ray_caster::RayCaster;
use crate::raytrace::path::specular_chain::follow;
use crate::raytrace::ray::{Ray, RaySource};
use crate::raytrace::sampler::Sampler;

/// Number of photons that are shot between two counts of those that have landed.
const BATCH: u32 = 1 << 17;

/// Photons in one task of a core.
const CHUNK: u32 = 1 << 12;

/// Shooting ends when this many photons have landed.
const ENOUGH: usize = 1 << 19;

/// Largest number of photons that are shot.
const MOST: u32 = 1 << 21;

/// Seed of the sequence of points that photons start from.
const SEED: u32 = 0x0b5e_55ed;

/// Luminous flux from lamps by way of mirrors `[t]`. Returns `None` if it was cancelled.
///
/// `side_of(triangle, is_front)` is the triangle that stands for a side of a surface.
pub(crate) fn flux_by_mirrors(
    rays: &RayCaster<'_>,
    side_of: impl Fn(TriangleId, bool) -> TriangleId + Sync,
    progress: &dyn Progress,
) -> Option<Vec<Vec3>> {
    let mut flux = vec![Vec3::ZERO; rays.scene().triangles.len()];
    let (mut num_shot, mut num_landed) = (0, 0);
    while num_shot < MOST && num_landed < ENOUGH && rays.lights.has_emitters() {
        let chunks = (num_shot..num_shot + BATCH).step_by(CHUNK as usize).collect::<Vec<_>>();
        let landed: Option<Vec<_>> = chunks
            .into_par_iter()
            .map(|first| (!progress.is_cancelled()).then(|| shoot(rays, first..first + CHUNK, &side_of)))
            .collect();
        for (side, carried) in landed?.into_iter().flatten() {
            flux[side.index()] += carried;
            num_landed += 1;
        }
        num_shot += BATCH;
    }
    let share = 1.0 / num_shot.max(1) as f32;
    flux.iter_mut().for_each(|flux| *flux *= share);
    Some(flux)
}

/// Returns the sides on which the photons with these numbers land, with their flux.
fn shoot(
    rays: &RayCaster<'_>,
    numbers: std::ops::Range<u32>,
    side_of: impl Fn(TriangleId, bool) -> TriangleId,
) -> Vec<(TriangleId, Vec3)> {
    let mut landed = Vec::new();
    for number in numbers {
        let mut sampler = Sampler::new(SEED, number);
        let Some(emission) = rays.lights.emit(&mut sampler) else { continue };
        let origin = rays.above(emission.point, emission.normal);
        let ray = Ray { origin, direction: emission.direction, source: RaySource::Unshared };
        follow(
            rays,
            ray,
            &mut sampler,
            |_| {},
            |surface, chain, _| {
                if chain.is_reflected && surface.reflectance != Vec3::ZERO {
                    landed.push((side_of(surface.triangle, surface.is_front), emission.flux * chain.throughput));
                }
            },
        );
    }
    landed
}
