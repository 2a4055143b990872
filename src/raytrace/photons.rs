//! Light that lamps throw by way of mirrors, shot from the lamps: no gathering ray finds a small lamp in a mirror.
//!
//! Only emissive surfaces shoot: path tracing does not find what mirrors throw of punctual lights either.
//!
//! Source: Arvo 1986, "Backward Ray Tracing" (light is stored on the surfaces that it lands on).

use glam::Vec3;
use rayon::prelude::*;

use super::mirrors::follow;
use super::path::{Chance, PathTracer, Ray};
use super::sampler::Sampler;
use crate::base::ids::TriangleId;
use crate::base::progress::Progress;

/// Photons shot between two looks at what has arrived.
const BATCH: u32 = 1 << 17;

/// Photons that one core shoots at a time.
const CHUNK: u32 = 1 << 12;

/// Photons that are enough where they land.
const ENOUGH: usize = 1 << 19;

/// Photons after which shooting ends in any case.
const MOST: u32 = 1 << 21;

/// Names the sequence of points that photons start from.
const SEED: u32 = 0x0b5e_55ed;

/// Luminous flux from lamps by way of mirrors `[t]`, landed on the side of a surface that `side_of` names. None where it
/// was cancelled.
pub(super) fn flux_by_mirrors(
    rays: &PathTracer<'_>,
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

/// What photons of these numbers carry to which side.
fn shoot(
    rays: &PathTracer<'_>,
    numbers: std::ops::Range<u32>,
    side_of: impl Fn(TriangleId, bool) -> TriangleId,
) -> Vec<(TriangleId, Vec3)> {
    let mut landed = Vec::new();
    for number in numbers {
        let mut sampler = Sampler::new(SEED, number);
        let Some(emission) = rays.lights.emit(&mut sampler) else { continue };
        let origin = rays.above(emission.point, emission.normal);
        let ray = Ray { origin, direction: emission.direction, chance: Chance::Only };
        follow(
            rays,
            ray,
            &mut sampler,
            |_| {},
            |surface, trail, _| {
                if trail.is_reflected && surface.reflectance != Vec3::ZERO {
                    landed.push((side_of(surface.triangle, surface.is_front), emission.flux * trail.throughput));
                }
            },
        );
    }
    landed
}
