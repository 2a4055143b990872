//! Direct light: what arrives straight from the lights, with exact formulas and visibility rays.
//!
//! It decides the quality of the picture and is therefore not left to hemicube pixels. Punctual lights take one ray a
//! place; emissive surfaces take the closed form times the visible share, which few rays find where all of them agree and
//! many where they do not (in penumbrae), until what more rays change is lost in the light of the place.

use std::sync::Arc;

use glam::Vec3;
use rayon::prelude::*;

use super::emitter::{Aim, Aims, Emitters};
use super::field::Field;
use crate::base::colour::luminance;
use crate::base::progress::{Progress, Stage};
use crate::base::sampling::hash;
use crate::form_factor::Viewpoint;
use crate::patch::PatchMesh;
use crate::scene::{Light, Scene};
use crate::trace::Tracer;

/// Places between two looks at the watch.
const BATCH: usize = 64;

/// Fewest and most rays that decide whether a place is in a penumbra.
const PILOT_RAYS: [u32; 2] = [16, 64];

/// Share of the rays in penumbrae that decide whether it is one.
const PILOT_SHARE: u32 = 8;

/// An emitter's visible share is settled when twice the rays change a place's light by less than this.
const SETTLED: f32 = 2e-3;

/// Smallest share of the irradiance in the brightest place that is worth tracing rays for.
const NEGLIGIBLE: f32 = 1e-7;

/// The lights of a scene, ready to be asked for their direct light.
pub struct DirectLight<'a> {
    scene: &'a Scene,
    tracer: &'a Tracer<'a>,
    emitters: Arc<Emitters>,
    num_penumbra_rays: u32,
}

impl<'a> DirectLight<'a> {
    /// Direct light of all lights of the scene; at most `num_penumbra_rays` rays a place and emitter within penumbrae.
    #[must_use]
    pub fn new(scene: &'a Scene, mesh: &PatchMesh, tracer: &'a Tracer<'a>, num_penumbra_rays: u32) -> Self {
        Self { scene, tracer, emitters: Arc::new(Emitters::new(scene, mesh)), num_penumbra_rays }
    }

    /// The same lights with another number of rays in penumbrae.
    #[must_use]
    pub fn with_rays(&self, num_penumbra_rays: u32) -> Self {
        Self { emitters: Arc::clone(&self.emitters), num_penumbra_rays, ..*self }
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
            values.par_chunks_mut(num_groups).zip(places).for_each_init(
                || (Aims::default(), Vec::new()),
                |(aims, tallies), (groups, viewpoint)| self.add_to(viewpoint, aims, tallies, groups),
            );
            progress.report(Stage::Direct, (batch * BATCH + places.len()) as f32 / viewpoints.len() as f32);
        }
        field
    }

    /// Adds the light of every group at one viewpoint.
    fn add_to(&self, viewpoint: &Viewpoint, aims: &mut Aims, tallies: &mut Vec<Tally>, groups: &mut [Vec3]) {
        for light in &self.scene.lights {
            groups[light.group.index()] += self.of_punctual(light, viewpoint);
        }
        self.emitters.aim(viewpoint.position, viewpoint.normal, aims);
        // A few rays to each emitter tell which are seen whole or not at all, and how bright the place is.
        let num_pilot_rays = (self.num_penumbra_rays / PILOT_SHARE).clamp(PILOT_RAYS[0], PILOT_RAYS[1]);
        tallies.clear();
        tallies.extend(aims.aims.iter().map(|aim| {
            let mut tally = Tally::default();
            self.shoot(aims, aim, viewpoint, num_pilot_rays, &mut tally);
            tally
        }));
        let punctual: f32 = groups.iter().map(|value| luminance(*value)).sum();
        let lit = |(aim, tally): (&Aim, &Tally)| luminance(aim.unoccluded) * tally.share();
        let whole = punctual + aims.aims.iter().zip(&*tallies).map(lit).sum::<f32>();
        for (aim, tally) in aims.aims.iter().zip(tallies) {
            self.settle(aims, aim, viewpoint, SETTLED * whole, tally);
            groups[aim.group.index()] += aim.unoccluded * tally.share();
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

    /// Doubles the rays to a partly hidden emitter until they change its luminance by less than `error`.
    fn settle(&self, aims: &Aims, aim: &Aim, viewpoint: &Viewpoint, error: f32, tally: &mut Tally) {
        let unoccluded = luminance(aim.unoccluded);
        while !tally.is_decided() && tally.num_rays < self.num_penumbra_rays {
            let before = tally.share();
            let num_rays = (2 * tally.num_rays).min(self.num_penumbra_rays);
            self.shoot(aims, aim, viewpoint, num_rays, tally);
            if unoccluded * (tally.share() - before).abs() < error {
                break;
            }
        }
    }

    /// Shoots rays at points of an emitter, weighted with their contribution, until there are `num_rays`.
    fn shoot(&self, aims: &Aims, aim: &Aim, viewpoint: &Viewpoint, num_rays: u32, tally: &mut Tally) {
        if aim.unoccluded.max_element() <= NEGLIGIBLE {
            return;
        }
        let from = (viewpoint.position, viewpoint.normal, hash(viewpoint.seed));
        for index in tally.num_rays..num_rays {
            let sample = self.emitters.sample(aims, aim, index, from);
            if sample.weight > 0.0 {
                // The ray ends just before the emitter.
                let to_emitter = sample.point - viewpoint.position;
                let passing = self.tracer.transmittance(viewpoint.position, to_emitter, 1.0 - 1e-4);
                tally.passing += sample.weight * passing;
                tally.whole += sample.weight;
            }
        }
        tally.num_rays = num_rays;
    }
}

/// Rays to one emitter so far: the weight of those that pass, and of all.
#[derive(Clone, Copy, Default)]
struct Tally {
    passing: f32,
    whole: f32,
    num_rays: u32,
}

impl Tally {
    /// Share of the emitter's irradiance that is not blocked.
    fn share(&self) -> f32 {
        if self.whole > 0.0 { self.passing / self.whole } else { 0.0 }
    }

    /// All rays agree.
    fn is_decided(&self) -> bool {
        self.passing <= 1e-4 * self.whole || self.passing >= (1.0 - 1e-4) * self.whole
    }
}
