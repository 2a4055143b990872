//! Direct irradiance at viewpoints, by exact formulas and visibility rays.
//!
//! Direct light dominates the quality of the picture, so it is not sampled by hemicube pixels. A punctual light takes
//! one ray per viewpoint: E = I cos theta / r^2 times the transmittance along the ray. An emissive surface takes the
//! closed form of its unoccluded irradiance, multiplied by its visible share. The share is estimated from a few rays if
//! all of them agree. In penumbrae the number of rays is doubled until this changes the irradiance of the viewpoint by
//! less than a given share.
//!
//! Source: Ward 1991, "Adaptive shadow testing for ray tracing" (rays by contribution).

use std::sync::Arc;

use glam::Vec3;
use rayon::prelude::*;

use super::emitter::{Candidate, Candidates, Emitters};
use crate::base::colour::luminance;
use crate::base::progress::{Progress, Stage};
use crate::base::sampling::hash;
use crate::form_factor::Viewpoint;
use crate::patch::PatchMesh;
use crate::radiosity::field::Field;
use crate::scene::{Light, Scene};
use crate::trace::Tracer;

/// Viewpoints between two progress reports.
const BATCH: usize = 64;

/// Smallest and largest number of rays that test whether a viewpoint lies in a penumbra.
const PILOT_RAYS: [u32; 2] = [16, 64];

/// Share of the rays in penumbrae that the test uses.
const PILOT_SHARE: u32 = 8;

/// The rays to an emitter suffice if doubling them changes the light of the viewpoint by less than this share.
const CONVERGED: f32 = 2e-3;

/// Irradiance below which no rays are traced, lux.
const NEGLIGIBLE: f32 = 1e-7;

/// The direct light of all lights of a scene.
pub struct DirectLight<'a> {
    scene: &'a Scene,
    tracer: &'a Tracer<'a>,
    emitters: Arc<Emitters>,
    num_penumbra_rays: u32,
}

impl<'a> DirectLight<'a> {
    /// Returns the direct light of all lights of the scene, with at most `num_penumbra_rays` rays per viewpoint and
    /// emitter in penumbrae.
    #[must_use]
    pub fn new(scene: &'a Scene, mesh: &PatchMesh, tracer: &'a Tracer<'a>, num_penumbra_rays: u32) -> Self {
        Self { scene, tracer, emitters: Arc::new(Emitters::new(scene, mesh)), num_penumbra_rays }
    }

    /// Returns the same lights with another number of rays in penumbrae.
    #[must_use]
    pub fn with_rays(&self, num_penumbra_rays: u32) -> Self {
        Self { emitters: Arc::clone(&self.emitters), num_penumbra_rays, ..*self }
    }

    /// Returns the tracer of the visibility rays.
    #[must_use]
    pub fn tracer(&self) -> &Tracer<'a> {
        self.tracer
    }

    /// Computes direct irradiance `[viewpoint][group]`, lux per channel; zero at viewpoints not reached before a
    /// cancel.
    pub fn irradiance(&self, viewpoints: &[Viewpoint], progress: &dyn Progress) -> Field {
        let num_groups = self.scene.light_groups.len();
        let mut field = Field::zero(viewpoints.len(), num_groups);
        if num_groups == 0 {
            return field;
        }
        let batches = field.values_mut().chunks_mut(BATCH * num_groups).zip(viewpoints.chunks(BATCH));
        for (batch, (values, some)) in batches.enumerate() {
            progress.rest();
            if progress.is_cancelled() {
                break;
            }
            values.par_chunks_mut(num_groups).zip(some).for_each_init(
                || (Candidates::default(), Vec::new()),
                |(candidates, visibilities), (groups, viewpoint)| {
                    self.add_irradiance(viewpoint, candidates, visibilities, groups);
                },
            );
            progress.report(Stage::Direct, (batch * BATCH + some.len()) as f32 / viewpoints.len() as f32);
        }
        field
    }

    /// Adds the irradiance of every group at one viewpoint.
    fn add_irradiance(
        &self,
        viewpoint: &Viewpoint,
        candidates: &mut Candidates,
        visibilities: &mut Vec<Visibility>,
        groups: &mut [Vec3],
    ) {
        for light in &self.scene.lights {
            groups[light.group.index()] += self.punctual_irradiance(light, viewpoint);
        }
        self.emitters.find_candidates(viewpoint.position, viewpoint.normal, candidates);
        let receiver = Receiver { lights: self, viewpoint, candidates };
        // A few rays to each emitter show whether it is wholly visible or hidden, and how bright the viewpoint is.
        let num_pilot_rays = (self.num_penumbra_rays / PILOT_SHARE).clamp(PILOT_RAYS[0], PILOT_RAYS[1]);
        visibilities.clear();
        visibilities.extend(receiver.candidates.list.iter().map(|candidate| {
            let mut visibility = Visibility::default();
            receiver.trace_rays(candidate, num_pilot_rays, &mut visibility);
            visibility
        }));
        let punctual: f32 = groups.iter().map(|value| luminance(*value)).sum();
        let visible =
            |(candidate, visibility): (&Candidate, &Visibility)| luminance(candidate.unoccluded) * visibility.share();
        let total = punctual + receiver.candidates.list.iter().zip(&*visibilities).map(visible).sum::<f32>();
        // More rays go to emitters that are partly hidden.
        for (candidate, visibility) in receiver.candidates.list.iter().zip(visibilities) {
            receiver.refine(candidate, CONVERGED * total, visibility);
            groups[candidate.group.index()] += candidate.unoccluded * visibility.share();
        }
    }

    /// Returns the irradiance from a punctual light.
    ///
    /// Equation: E = I cos theta / r^2 (directional light: E cos theta), times the transmittance along the ray.
    fn punctual_irradiance(&self, light: &Light, viewpoint: &Viewpoint) -> Vec3 {
        let arrival = light.arrival(viewpoint.position);
        let cosine = viewpoint.normal.dot(arrival.to_light);
        if cosine <= 0.0 || arrival.irradiance.max_element() <= NEGLIGIBLE {
            return Vec3::ZERO;
        }
        let passing = self.tracer.transmittance(viewpoint.position, arrival.to_light, arrival.distance);
        arrival.irradiance * (cosine * passing)
    }
}

/// A viewpoint and the emitters that it samples.
struct Receiver<'a> {
    lights: &'a DirectLight<'a>,
    viewpoint: &'a Viewpoint,
    candidates: &'a Candidates,
}

impl Receiver<'_> {
    /// Doubles the rays to a partly hidden emitter until they change the luminance of its irradiance by less
    /// than `error`.
    fn refine(&self, candidate: &Candidate, error: f32, visibility: &mut Visibility) {
        let unoccluded = luminance(candidate.unoccluded);
        let max_rays = self.lights.num_penumbra_rays;
        while !visibility.is_unanimous() && visibility.num_rays < max_rays {
            let before = visibility.share();
            let num_rays = (2 * visibility.num_rays).min(max_rays);
            self.trace_rays(candidate, num_rays, visibility);
            if unoccluded * (visibility.share() - before).abs() < error {
                break;
            }
        }
    }

    /// Traces rays to points of an emitter until there are `num_rays`. Each is weighted by its point's contribution.
    fn trace_rays(&self, candidate: &Candidate, num_rays: u32, visibility: &mut Visibility) {
        if candidate.unoccluded.max_element() <= NEGLIGIBLE {
            return;
        }
        let Viewpoint { position, normal, seed } = *self.viewpoint;
        let from = (position, normal, hash(seed));
        for index in visibility.num_rays..num_rays {
            let sample = self.lights.emitters.sample(self.candidates, candidate, index, from);
            if sample.weight > 0.0 {
                // The ray ends slightly before the emitter.
                let to_emitter = sample.point - position;
                let passing = self.lights.tracer.transmittance(position, to_emitter, 1.0 - 1e-4);
                visibility.passing += sample.weight * passing;
                visibility.total += sample.weight;
            }
        }
        visibility.num_rays = num_rays;
    }
}

/// Estimate of the visible share of one emitter: summed weight of the rays that pass, and summed weight of all rays.
#[derive(Clone, Copy, Default)]
struct Visibility {
    passing: f32,
    total: f32,
    num_rays: u32,
}

impl Visibility {
    /// Share of the emitter's irradiance that is not blocked.
    fn share(&self) -> f32 {
        if self.total > 0.0 { self.passing / self.total } else { 0.0 }
    }

    /// Returns true if all rays agree.
    fn is_unanimous(&self) -> bool {
        self.passing <= 1e-4 * self.total || self.passing >= (1.0 - 1e-4) * self.total
    }
}
