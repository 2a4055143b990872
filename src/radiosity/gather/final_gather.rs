//! The final gather: hemicubes at a sparse set of viewpoints, and interpolation between them.
//!
//! E(x) = sum over elements e of F(x, e) B_e is evaluated at *records*, the viewpoints that the [irradiance
//! cache](super::irradiance_cache) finds too far from all others. Records are densest where light changes fast.
//!
//! Source: Wallace, Elmquist, Haines 1989 (radiosity at vertices); Lischinski, Tampieri, Greenberg 1993 (final gather
//! of a radiosity solution).

use glam::Vec3;
use rayon::prelude::*;

use super::irradiance_cache::IrradianceCache;
use super::near_field::{NearElement, NearField};
use super::plane_fit::fit_plane;
use super::sampled_view::SampledView;
use super::sampling_noise::{SamplingNoise, irradiance_and_variance};
use crate::base::progress::{Progress, Stage};
use crate::base::sampling::hash;
use crate::form_factor::{FormFactorError, FormFactorSource, MAX_BACK_SHARE, Row, Viewpoint, map_rows};
use crate::patch::PatchMesh;
use crate::radiosity::field::Field;

/// Largest number of viewpoints gathered before the cache and the noise are evaluated again. The first rounds are
/// small, because later ones use their results: each is twice as large as all before it together.
const ROUND: usize = 512;
const FIRST_ROUND: usize = 32;

/// Iterations of the near-field correction; each multiplies the error by reflectance times form factor of the near
/// elements.
const NEAR_FIELD_ROUNDS: usize = 3;

/// Where and how densely light is gathered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FinalGatherSettings {
    /// Largest error of the irradiance cache.
    pub tolerance: f32,
    /// Largest radius of a record, metres.
    pub max_radius: f32,
    /// Accepted standard deviation of one record, relative to its irradiance.
    pub noise: f32,
    /// Distance up to which the light of elements is corrected, metres.
    pub near_field_reach: f32,
}

/// Indirect light at viewpoints.
pub struct GatheredLight {
    /// Indirect irradiance `[viewpoint][group]`, lux per channel.
    pub indirect: Field,
    /// True if the viewpoint lies on an open surface, not inside or behind a wall.
    pub is_valid: Vec<bool>,
    /// True if the light of the viewpoint is known; false if the gather was cancelled before.
    pub is_known: Vec<bool>,
}

/// Gathers reflected radiosity at one set of viewpoints after the other; the records of one set serve the next.
pub struct FinalGather<'a> {
    radiosity: &'a Field,
    centroids: Vec<Vec3>,
    cache: IrradianceCache,
    near_field: NearField<'a>,
    noise: SamplingNoise,
    records: Vec<Record>,
    /// Irradiance `[record][group]` without and with the near-field correction.
    gathered: Vec<Vec3>,
    irradiance: Vec<Vec3>,
    /// Near elements of all records, record by record.
    near_elements: Vec<NearElement>,
    /// Sum of the back face shares over all viewpoints with hemicubes, and the number of these viewpoints.
    back_share: f32,
    num_viewpoints: usize,
    /// Hemicubes (or hemispheres) sampled so far.
    pub num_hemicubes: usize,
}

/// A viewpoint whose irradiance others interpolate.
struct Record {
    position: Vec3,
    /// End of its near elements; they begin at the end of the record before.
    end_of_near_elements: usize,
}

impl<'a> FinalGather<'a> {
    /// Returns a gather of `radiosity` `[e][g]` that has no records yet.
    #[must_use]
    pub fn new(mesh: &'a PatchMesh, radiosity: &'a Field, settings: FinalGatherSettings) -> Self {
        Self {
            radiosity,
            centroids: mesh.elements.iter().map(|element| mesh.centroid(element)).collect(),
            cache: IrradianceCache::new(settings.tolerance, settings.max_radius),
            near_field: NearField::new(mesh, radiosity, settings.near_field_reach),
            noise: SamplingNoise::new(settings.noise, settings.max_radius),
            records: Vec::new(),
            gathered: Vec::new(),
            irradiance: Vec::new(),
            near_elements: Vec::new(),
            back_share: 0.0,
            num_viewpoints: 0,
            num_hemicubes: 0,
        }
    }

    /// Returns the mean share of back faces in view, over all viewpoints with hemicubes.
    #[must_use]
    pub fn mean_back_share(&self) -> f32 {
        self.back_share / self.num_viewpoints.max(1) as f32
    }

    /// Gathers at all `viewpoints`.
    ///
    /// Equation: E = sum over elements of F(viewpoint, e) B_e.
    ///
    /// # Errors
    /// Returns an error if the form factors cannot be computed.
    pub fn at(
        &mut self,
        source: &mut dyn FormFactorSource,
        viewpoints: &[Viewpoint],
        progress: &dyn Progress,
    ) -> Result<GatheredLight, FormFactorError> {
        let mut light = GatheredLight::unknown(viewpoints.len(), self.radiosity.num_groups());
        let order = scattered_order(viewpoints.len());
        let mut next = 0;
        while next < order.len() && !progress.is_cancelled() {
            let chosen = self.choose(&order, &mut next, viewpoints);
            self.sample(source, &chosen, viewpoints, &mut light, progress)?;
            progress.report(Stage::Gather, next as f32 / order.len() as f32);
        }
        self.interpolate(viewpoints, &mut light);
        Ok(light)
    }

    /// Chooses the next viewpoints in `order`, from `next` on, that no record covers.
    fn choose(&self, order: &[u32], next: &mut usize, viewpoints: &[Viewpoint]) -> Vec<u32> {
        let mut chosen = Vec::with_capacity(ROUND);
        let round = (2 * self.num_viewpoints).clamp(FIRST_ROUND, ROUND);
        while chosen.len() < round && *next < order.len() {
            let viewpoint = order[*next];
            if !self.cache.covers(&viewpoints[viewpoint as usize]) {
                chosen.push(viewpoint);
            }
            *next += 1;
        }
        chosen
    }

    /// Samples the view of the `chosen` viewpoints, as often as the noise around them demands, and makes them records.
    fn sample(
        &mut self,
        source: &mut dyn FormFactorSource,
        chosen: &[u32],
        viewpoints: &[Viewpoint],
        light: &mut GatheredLight,
        progress: &dyn Progress,
    ) -> Result<(), FormFactorError> {
        let may_continue = || {
            progress.rest();
            !progress.is_cancelled()
        };
        let counts: Vec<u32> = chosen.iter().map(|&v| self.noise.num_hemicubes(&viewpoints[v as usize])).collect();
        let seeds = chosen.iter().zip(&counts).flat_map(|(&v, &count)| (0..count).map(move |i| (v, i)));
        let sampled: Vec<Viewpoint> = seeds.map(|(v, i)| reseeded(&viewpoints[v as usize], i)).collect();
        let num_samples = source.num_samples() as f32;
        let reduce = |index: usize, row: &Row| {
            (self.view(row, &sampled[index]), irradiance_and_variance(row, self.radiosity, num_samples))
        };
        let mut views = map_rows(source, &sampled, &may_continue, reduce)?.into_iter();
        for (&v, &count) in chosen.iter().zip(&counts) {
            let (views, noise): (Vec<SampledView>, Vec<_>) = views.by_ref().take(count as usize).unzip();
            if views.len() < count as usize {
                break;
            }
            let viewpoint = &viewpoints[v as usize];
            noise.iter().for_each(|&(irradiance, variance)| self.noise.add(viewpoint, irradiance, variance));
            self.num_hemicubes += views.len();
            let view = SampledView::mean(views);
            light.set(v as usize, &view);
            self.add_record(viewpoint, view);
        }
        Ok(())
    }

    /// Applies the near-field correction to `light`, now that the light of vertices is known. `direct` and `light` are
    /// the light of the light vertices, whose viewpoints are `viewpoints`.
    pub fn correct_near_field(&mut self, viewpoints: &[Viewpoint], direct: &Field, light: &mut GatheredLight) {
        for _ in 0..NEAR_FIELD_ROUNDS {
            self.near_field.set_vertex_light(direct, &light.indirect, &light.is_valid);
            let num_groups = self.radiosity.num_groups().max(1);
            let (near_field, records, near_elements) = (&self.near_field, &self.records, &self.near_elements);
            let corrected = self.irradiance.par_chunks_mut(num_groups).zip(self.gathered.par_chunks(num_groups));
            corrected.enumerate().for_each(|(r, (irradiance, gathered))| {
                let first = r.checked_sub(1).map_or(0, |before| records[before].end_of_near_elements);
                irradiance.copy_from_slice(gathered);
                let near = &near_elements[first..records[r].end_of_near_elements];
                near_field.correct(near, records[r].position, irradiance);
            });
            self.interpolate(viewpoints, light);
        }
    }

    /// Irradiance, back faces, distances and near elements from one row.
    fn view(&self, row: &Row, viewpoint: &Viewpoint) -> SampledView {
        let mut irradiance = vec![Vec3::ZERO; self.radiosity.num_groups()];
        let (mut inverse_distance, mut sum) = (0.0, 0.0);
        for entry in &row.entries {
            for (sum, &radiosity) in irradiance.iter_mut().zip(self.radiosity.at(entry.element.index())) {
                *sum += entry.factor * radiosity;
            }
        }
        // The harmonic mean distance of all surfaces in view, black backs included.
        for entry in row.entries.iter().chain(&row.backs) {
            let distance = self.centroids[entry.element.index()].distance(viewpoint.position);
            inverse_distance += entry.factor * distance.recip();
            sum += entry.factor;
        }
        let distance = if inverse_distance > 0.0 { sum / inverse_distance } else { f32::MAX };
        let (near, nearest) = self.near_field.near_elements(row, viewpoint.position);
        SampledView { irradiance, near, back: row.back(), distance, nearest }
    }

    /// Makes a viewpoint a record, unless it lies inside a solid.
    fn add_record(&mut self, viewpoint: &Viewpoint, view: SampledView) {
        self.back_share += view.back;
        self.num_viewpoints += 1;
        if view.back <= MAX_BACK_SHARE {
            self.cache.insert(viewpoint, view.distance, view.nearest, self.records.len() as u32);
            let SampledView { mut irradiance, near, .. } = view;
            self.gathered.extend(&irradiance);
            self.near_field.correct(&near, viewpoint.position, &mut irradiance);
            self.irradiance.extend(irradiance);
            self.near_elements.extend(near);
            let end_of_near_elements = self.near_elements.len();
            self.records.push(Record { position: viewpoint.position, end_of_near_elements });
        }
    }

    /// Fits a plane through the records near each valid viewpoint, its own included, and sets the light of the
    /// viewpoint to the value of the plane.
    fn interpolate(&self, viewpoints: &[Viewpoint], light: &mut GatheredLight) {
        let num_groups = self.radiosity.num_groups();
        let GatheredLight { indirect, is_valid, is_known } = light;
        let values = indirect.values_mut().par_chunks_mut(num_groups.max(1)).zip(is_known).zip(is_valid);
        values.zip(viewpoints).for_each_init(Vec::new, |weights, (((sums, is_known), is_valid), viewpoint)| {
            self.cache.weights(viewpoint, weights);
            if !*is_valid || weights.is_empty() {
                return;
            }
            fit_plane(viewpoint, weights, |record| self.records[record as usize].position);
            *is_known = true;
            sums.fill(Vec3::ZERO);
            for &(record, weight) in &*weights {
                let irradiance = &self.irradiance[record as usize * num_groups..];
                sums.iter_mut().zip(irradiance).for_each(|(sum, &value)| *sum += value * weight);
            }
            sums.iter_mut().for_each(|sum| *sum = sum.max(Vec3::ZERO));
        });
    }
}

/// Returns all viewpoints in an order that covers the scene evenly from the start.
fn scattered_order(num_viewpoints: usize) -> Vec<u32> {
    let mut order: Vec<u32> = (0..num_viewpoints as u32).collect();
    order.sort_by_key(|&viewpoint| hash(viewpoint));
    order
}

/// Returns the viewpoint with its `i`-th seed. Each seed places the samples differently.
fn reseeded(viewpoint: &Viewpoint, i: u32) -> Viewpoint {
    Viewpoint { seed: viewpoint.seed ^ i.wrapping_mul(0x85eb_ca6b), ..*viewpoint }
}

impl GatheredLight {
    /// Returns light of which nothing is known yet.
    #[must_use]
    pub fn unknown(num_viewpoints: usize, num_groups: usize) -> Self {
        Self {
            indirect: Field::zero(num_viewpoints, num_groups),
            is_valid: vec![true; num_viewpoints],
            is_known: vec![false; num_viewpoints],
        }
    }

    fn set(&mut self, viewpoint: usize, view: &SampledView) {
        self.indirect.at_mut(viewpoint).copy_from_slice(&view.irradiance);
        self.is_known[viewpoint] = true;
        self.is_valid[viewpoint] = view.back <= MAX_BACK_SHARE;
    }
}
