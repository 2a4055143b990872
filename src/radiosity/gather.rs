//! Gathering: the indirect irradiance at every site, from hemicubes over the solved elements.
//!
//! A hemicube stands at every site of a sparse set that grows where light changes fast; the sites between borrow from them
//! through the [irradiance cache](super::cache).
//!
//! Source: Wallace, Elmquist, Haines 1989 (radiosity at vertices); Lischinski, Tampieri, Greenberg 1993 (final gather of
//! a radiosity solution).

use glam::{Mat2, Vec2, Vec3};
use rayon::prelude::*;

use super::cache::IrradianceCache;
use super::contacts::{Contact, Contacts};
use super::field::Field;
use super::noise::{Noise, irradiance_and_variance};
use super::sight::Sight;
use crate::base::progress::{Progress, Stage};
use crate::base::sampling::{hash, tangent_frame};
use crate::form_factor::{FormFactorError, FormFactorSource, MAX_BACK_SHARE, Row, Viewpoint, map_rows};
use crate::patch::PatchMesh;

/// Sites gathered before the cache and the noise are asked again: few at first, so that what they find serves the next, then
/// twice as many as before, at most `ROUND`.
const ROUND: usize = 512;
const FIRST_ROUND: usize = 32;

/// Stiffness of the plane through records, as a share of how far they scatter.
const STIFFNESS: f32 = 0.1;

/// Times that contacts are found anew; each leaves less than the reflectance times their form factor of the error.
const CONTACT_ROUNDS: usize = 3;

/// Where and how densely light is gathered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GatherSettings {
    /// Largest error of the irradiance cache.
    pub tolerance: f32,
    /// Farthest that a site is borrowed from, metres.
    pub max_radius: f32,
    /// Standard deviation that sampling may leave at one site, relative to the irradiance.
    pub noise: f32,
    /// How close elements must be to reflect the light of their own vertices, metres.
    pub contact_reach: f32,
}

/// Indirect light at sites.
pub struct Gathered {
    /// Indirect irradiance `[site][group]`, lux per channel.
    pub indirect: Field,
    /// The site lies on an open surface, not inside or behind a wall.
    pub is_valid: Vec<bool>,
    /// The light of the site is known; false where it was cancelled before.
    pub is_known: Vec<bool>,
}

/// Gathers the reflected radiosity at one set of sites after the other; what one set finds serves the next.
pub struct Gatherer<'a> {
    radiosity: &'a Field,
    centroids: Vec<Vec3>,
    cache: IrradianceCache,
    contacts: Contacts<'a>,
    noise: Noise,
    /// The sites that others borrow from.
    records: Vec<Record>,
    /// Irradiance `[record][group]` as gathered, and with the light of contacts.
    gathered: Vec<Vec3>,
    irradiance: Vec<Vec3>,
    /// Contacts of all records, record by record.
    close: Vec<Contact>,
    /// Sum over the sites that were looked from, and their number.
    back_share: f32,
    num_seen: usize,
    /// Hemicubes that stood at sites.
    pub num_hemicubes: usize,
}

/// A site that others borrow from.
struct Record {
    place: Vec3,
    /// Its contacts: from the end of the record before to this one's.
    end_of_contacts: usize,
}

impl<'a> Gatherer<'a> {
    /// Nothing is known yet of the light that `radiosity` `[e][g]` brings.
    #[must_use]
    pub fn new(mesh: &'a PatchMesh, radiosity: &'a Field, settings: GatherSettings) -> Self {
        Self {
            radiosity,
            centroids: mesh.elements.iter().map(|element| mesh.centroid(element)).collect(),
            cache: IrradianceCache::new(settings.tolerance, settings.max_radius),
            contacts: Contacts::new(mesh, radiosity, settings.contact_reach),
            noise: Noise::new(settings.noise, settings.max_radius),
            records: Vec::new(),
            gathered: Vec::new(),
            irradiance: Vec::new(),
            close: Vec::new(),
            back_share: 0.0,
            num_seen: 0,
            num_hemicubes: 0,
        }
    }

    /// Share of back faces seen, mean over all sites that were looked from.
    #[must_use]
    pub fn mean_back_share(&self) -> f32 {
        self.back_share / self.num_seen.max(1) as f32
    }

    /// Gathers at all `sites`.
    ///
    /// Equation: E = sum over elements of F(site, e) B_e.
    ///
    /// # Errors
    /// The form factors could not be found.
    pub fn at(
        &mut self,
        method: &mut dyn FormFactorSource,
        sites: &[Viewpoint],
        progress: &dyn Progress,
    ) -> Result<Gathered, FormFactorError> {
        let go_on = || {
            progress.rest();
            !progress.is_cancelled()
        };
        let mut gathered = Gathered::nothing(sites.len(), self.radiosity.num_groups());
        let order = scattered_order(sites.len());
        let mut next = 0;
        while next < order.len() && !progress.is_cancelled() {
            // Choose the next sites that no hemicube near them serves.
            let mut chosen = Vec::with_capacity(ROUND);
            let round = (2 * self.num_seen).clamp(FIRST_ROUND, ROUND);
            while chosen.len() < round && next < order.len() {
                let site = order[next];
                if !self.cache.serves(&sites[site as usize]) {
                    chosen.push(site);
                }
                next += 1;
            }
            // Take as many looks at each as its neighbourhood is noisy.
            let num_looks: Vec<u32> = chosen.iter().map(|&site| self.noise.looks(&sites[site as usize])).collect();
            let looks = chosen.iter().zip(&num_looks).flat_map(|(&site, &n)| (0..n).map(move |i| (site, i)));
            let looks: Vec<Viewpoint> = looks.map(|(site, i)| other_look(&sites[site as usize], i)).collect();
            let num_samples = method.num_samples() as f32;
            let see = |index: usize, row: &Row| {
                (self.see(row, &looks[index]), irradiance_and_variance(row, self.radiosity, num_samples))
            };
            let mut sights = map_rows(method, &looks, &go_on, see)?.into_iter();
            for (&site, &num_looks) in chosen.iter().zip(&num_looks) {
                let (seen, noise): (Vec<Sight>, Vec<_>) = sights.by_ref().take(num_looks as usize).unzip();
                if seen.len() < num_looks as usize {
                    break;
                }
                let viewpoint = &sites[site as usize];
                noise.iter().for_each(|&(irradiance, variance)| self.noise.learn(viewpoint, irradiance, variance));
                self.num_hemicubes += seen.len();
                let sight = Sight::mean(seen);
                gathered.enter(site as usize, &sight);
                self.remember(viewpoint, sight);
            }
            progress.report(Stage::Gather, next as f32 / order.len() as f32);
        }
        self.blend(sites, &mut gathered);
        Ok(gathered)
    }

    /// Gathers anew, at sites that were gathered at, what close elements reflect now that the light of vertices is known:
    /// `direct` and `gathered` are that of the light vertices, whose sites are `sites`.
    pub fn settle_contacts(&mut self, sites: &[Viewpoint], direct: &Field, gathered: &mut Gathered) {
        for _ in 0..CONTACT_ROUNDS {
            self.contacts.learn(direct, &gathered.indirect, &gathered.is_valid);
            let num_groups = self.radiosity.num_groups().max(1);
            let (contacts, records, close) = (&self.contacts, &self.records, &self.close);
            let corrected = self.irradiance.par_chunks_mut(num_groups).zip(self.gathered.par_chunks(num_groups));
            corrected.enumerate().for_each(|(r, (irradiance, gathered))| {
                let first = r.checked_sub(1).map_or(0, |before| records[before].end_of_contacts);
                irradiance.copy_from_slice(gathered);
                contacts.correct(&close[first..records[r].end_of_contacts], records[r].place, irradiance);
            });
            self.blend(sites, gathered);
        }
    }

    /// Irradiance, back faces, distances and contacts from one row.
    fn see(&self, row: &Row, viewpoint: &Viewpoint) -> Sight {
        let mut irradiance = vec![Vec3::ZERO; self.radiosity.num_groups()];
        let (mut inverse_distance, mut seen) = (0.0, 0.0);
        for entry in &row.entries {
            for (sum, &radiosity) in irradiance.iter_mut().zip(self.radiosity.at(entry.element.index())) {
                *sum += entry.factor * radiosity;
            }
        }
        for entry in row.entries.iter().chain(&row.backs) {
            let distance = self.centroids[entry.element.index()].distance(viewpoint.position);
            inverse_distance += entry.factor * distance.recip();
            seen += entry.factor;
        }
        let distance = if inverse_distance > 0.0 { seen / inverse_distance } else { f32::MAX };
        let (contacts, nearest) = self.contacts.of(row, viewpoint.position);
        Sight { irradiance, contacts, back: row.back(), distance, nearest }
    }

    fn remember(&mut self, viewpoint: &Viewpoint, sight: Sight) {
        self.back_share += sight.back;
        self.num_seen += 1;
        if sight.back <= MAX_BACK_SHARE {
            self.cache.insert(viewpoint, sight.distance, sight.nearest, self.records.len() as u32);
            let Sight { mut irradiance, contacts, .. } = sight;
            self.gathered.extend(&irradiance);
            self.contacts.correct(&contacts, viewpoint.position, &mut irradiance);
            self.irradiance.extend(irradiance);
            self.close.extend(contacts);
            self.records.push(Record { place: viewpoint.position, end_of_contacts: self.close.len() });
        }
    }

    /// Gives every open site what a plane through the records near it, its own included, says of its place.
    fn blend(&self, sites: &[Viewpoint], gathered: &mut Gathered) {
        let num_groups = self.radiosity.num_groups();
        let Gathered { indirect, is_valid, is_known } = gathered;
        let places = indirect.values_mut().par_chunks_mut(num_groups.max(1)).zip(is_known).zip(is_valid);
        places.zip(sites).for_each_init(Vec::new, |weights, (((sums, is_known), is_valid), viewpoint)| {
            self.cache.weights(viewpoint, weights);
            if !*is_valid || weights.is_empty() {
                return;
            }
            self.fit_plane(viewpoint, weights);
            *is_known = true;
            sums.fill(Vec3::ZERO);
            for &(record, weight) in &*weights {
                let irradiance = &self.irradiance[record as usize * num_groups..];
                sums.iter_mut().zip(irradiance).for_each(|(sum, &value)| *sum += value * weight);
            }
            sums.iter_mut().for_each(|sum| *sum = sum.max(Vec3::ZERO));
        });
    }

    /// Turns the weights of a mean into those of the value at the viewpoint of the plane that fits the records best, so that
    /// records to one side only do not pull it to theirs.
    ///
    /// Source: Lancaster, Salkauskas 1981, "Surfaces generated by moving least squares methods".
    fn fit_plane(&self, viewpoint: &Viewpoint, weights: &mut [(u32, f32)]) {
        let (x, y) = tangent_frame(viewpoint.normal);
        let offset = |record: u32| {
            let offset = self.records[record as usize].place - viewpoint.position;
            Vec2::new(offset.dot(x), offset.dot(y))
        };
        let (mut first, mut second) = (Vec2::ZERO, Mat2::ZERO);
        for &(record, weight) in &*weights {
            let offset = offset(record);
            first += weight * offset;
            second += weight * Mat2::from_cols(offset * offset.x, offset * offset.y);
        }
        // A little stiffness keeps few records, or records in a row, from saying too much.
        let stiffness = STIFFNESS * (second.x_axis.x + second.y_axis.y);
        let stiff = second + Mat2::from_diagonal(Vec2::splat(stiffness));
        if stiff.determinant() <= f32::MIN_POSITIVE {
            return;
        }
        let slope = stiff.inverse() * first;
        let mut sum = 0.0;
        for (record, weight) in &mut *weights {
            *weight *= 1.0 - offset(*record).dot(slope);
            sum += *weight;
        }
        weights.iter_mut().for_each(|(_, weight)| *weight /= sum);
    }
}

/// All sites in an order that covers the scene evenly from the start.
fn scattered_order(num_sites: usize) -> Vec<u32> {
    let mut order: Vec<u32> = (0..num_sites as u32).collect();
    order.sort_by_key(|&site| hash(site));
    order
}

/// The viewpoint of the `i`-th look from a site: the samples fall elsewhere each time.
fn other_look(site: &Viewpoint, i: u32) -> Viewpoint {
    Viewpoint { seed: site.seed ^ i.wrapping_mul(0x85eb_ca6b), ..*site }
}

impl Gathered {
    /// No site is known.
    #[must_use]
    pub fn nothing(num_sites: usize, num_groups: usize) -> Self {
        Self {
            indirect: Field::zero(num_sites, num_groups),
            is_valid: vec![true; num_sites],
            is_known: vec![false; num_sites],
        }
    }

    fn enter(&mut self, site: usize, sight: &Sight) {
        self.indirect.at_mut(site).copy_from_slice(&sight.irradiance);
        self.is_known[site] = true;
        self.is_valid[site] = sight.back <= MAX_BACK_SHARE;
    }
}
