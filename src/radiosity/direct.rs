//! Direct light: what arrives straight from the lights, with exact formulas and visibility rays.
//!
//! It decides the quality of the picture and is therefore not left to hemicube pixels. Punctual lights take one ray a
//! place; emissive surfaces take the closed form times the visible share, which few rays find where all of them agree and
//! many where they do not (in penumbrae).

use glam::Vec3;
use rayon::prelude::*;

use super::emitter::{Emitter, emitters};
use super::field::Field;
use crate::base::progress::{Progress, Stage};
use crate::base::sampling::hash;
use crate::form_factor::Viewpoint;
use crate::patch::PatchMesh;
use crate::scene::{Light, Scene};
use crate::trace::Tracer;

/// Places between two looks at the watch.
const BATCH: usize = 64;

/// Rays that decide whether a place is in a penumbra.
const NUM_PILOT_RAYS: u32 = 16;

/// Smallest share of the irradiance in the brightest place that is worth tracing rays for.
const NEGLIGIBLE: f32 = 1e-7;

/// The lights of a scene, ready to be asked for their direct light.
pub struct DirectLight<'a> {
    scene: &'a Scene,
    tracer: &'a Tracer<'a>,
    emitters: Vec<Emitter>,
    num_penumbra_rays: u32,
}

impl<'a> DirectLight<'a> {
    /// Direct light of all lights of the scene; `num_penumbra_rays` rays a place and emitter within penumbrae.
    #[must_use]
    pub fn new(scene: &'a Scene, mesh: &PatchMesh, tracer: &'a Tracer<'a>, num_penumbra_rays: u32) -> Self {
        Self { scene, tracer, emitters: emitters(scene, mesh), num_penumbra_rays }
    }

    /// The same lights with another number of rays in penumbrae.
    #[must_use]
    pub fn with_rays(self, num_penumbra_rays: u32) -> Self {
        Self { num_penumbra_rays, ..self }
    }

    /// Direct irradiance `[place][group]` at all viewpoints, lux per channel; zero for those not reached when cancelled.
    pub fn irradiance(&self, viewpoints: &[Viewpoint], progress: &dyn Progress) -> Field {
        let num_groups = self.scene.light_groups.len();
        let mut field = Field::zero(viewpoints.len(), num_groups);
        if num_groups == 0 {
            return field;
        }
        let batches = field.values_mut().chunks_mut(BATCH * num_groups).zip(viewpoints.chunks(BATCH));
        for (batch, (values, places)) in batches.enumerate() {
            progress.rest();
            if progress.is_cancelled() {
                break;
            }
            values
                .par_chunks_mut(num_groups)
                .zip(places)
                .for_each(|(groups, viewpoint)| self.add_to(viewpoint, groups));
            progress.report(Stage::Direct, (batch * BATCH + places.len()) as f32 / viewpoints.len() as f32);
        }
        field
    }

    /// Adds the light of every group at one viewpoint.
    fn add_to(&self, viewpoint: &Viewpoint, groups: &mut [Vec3]) {
        for light in &self.scene.lights {
            groups[light.group.index()] += self.of_punctual(light, viewpoint);
        }
        for emitter in &self.emitters {
            groups[emitter.group.index()] += self.of_emitter(emitter, viewpoint);
        }
    }

    fn of_punctual(&self, light: &Light, viewpoint: &Viewpoint) -> Vec3 {
        let arrival = light.arrival(viewpoint.position);
        let cosine = viewpoint.normal.dot(arrival.to_light);
        if cosine <= 0.0 || arrival.irradiance.max_element() <= NEGLIGIBLE {
            return Vec3::ZERO;
        }
        let passing = self.tracer.transmittance(viewpoint.position, arrival.to_light, arrival.distance);
        arrival.irradiance * (cosine * passing)
    }

    fn of_emitter(&self, emitter: &Emitter, viewpoint: &Viewpoint) -> Vec3 {
        let unoccluded = emitter.unoccluded(viewpoint.position, viewpoint.normal);
        if unoccluded.max_element() <= NEGLIGIBLE {
            return Vec3::ZERO;
        }
        unoccluded * self.visible_share(emitter, viewpoint)
    }

    /// Share of the emitter's irradiance that is not blocked, by rays to points on it weighted with their contribution.
    fn visible_share(&self, emitter: &Emitter, viewpoint: &Viewpoint) -> f32 {
        let seed = hash(viewpoint.seed);
        let (mut passing, mut whole) = (0.0, 0.0);
        for index in 0..self.num_penumbra_rays.max(NUM_PILOT_RAYS) {
            let sample = emitter.sample(index, seed, viewpoint.position, viewpoint.normal);
            if sample.weight > 0.0 {
                // The ray ends just before the emitter.
                let to_emitter = sample.point - viewpoint.position;
                passing += sample.weight * self.tracer.transmittance(viewpoint.position, to_emitter, 1.0 - 1e-4);
                whole += sample.weight;
            }
            let is_decided = passing <= 1e-4 * whole || passing >= (1.0 - 1e-4) * whole;
            if index + 1 == NUM_PILOT_RAYS && is_decided {
                break;
            }
        }
        if whole > 0.0 { passing / whole } else { 0.0 }
    }
}
