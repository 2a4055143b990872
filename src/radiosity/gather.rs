//! Gathering: the indirect irradiance at every site, from hemicubes over the solved elements.
//!
//! A hemicube stands at every site of a sparse set that grows where light changes fast; the sites between borrow from them
//! through the [irradiance cache](super::cache).
//!
//! Source: Wallace, Elmquist, Haines 1989 (radiosity at vertices); Lischinski, Tampieri, Greenberg 1993 (final gather of
//! a radiosity solution).

use glam::Vec3;

use super::cache::IrradianceCache;
use super::field::Field;
use crate::base::progress::{Progress, Stage};
use crate::base::sampling::hash;
use crate::form_factor::{FormFactorError, FormFactors, Row, Viewpoint, map_rows};
use crate::patch::PatchMesh;

/// A site that sees more back faces than this share lies inside something.
const MAX_BACK_SHARE: f32 = 0.8;

/// Sites gathered before the cache is asked again.
const ROUND: usize = 512;

/// Where and how densely light is gathered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GatherSettings {
    /// Largest error of the irradiance cache; 0 gathers at every site.
    pub tolerance: f32,
    /// Farthest that a site is borrowed from, metres.
    pub max_radius: f32,
}

/// Indirect light at sites.
pub struct Gathered {
    /// Indirect irradiance `[site][group]`, lux per channel.
    pub indirect: Field,
    /// The site lies on an open surface, not inside or behind a wall.
    pub is_valid: Vec<bool>,
    /// The light of the site is known; false where it was cancelled before.
    pub is_known: Vec<bool>,
    /// Share of back faces seen, mean over all hemicubes.
    pub mean_back_share: f32,
    /// Hemicubes that stood at sites.
    pub num_hemicubes: usize,
}

/// What a hemicube tells of its site.
struct Sight {
    irradiance: Vec<Vec3>,
    back: f32,
    /// Harmonic mean distance, metres.
    distance: f32,
    /// Distance of the nearest element, metres.
    nearest: f32,
}

/// Gathers the reflected `radiosity` `[e][g]` at all `sites`.
///
/// Equation: E = sum over elements of F(site, e) B_e.
///
/// # Errors
/// The form factors could not be found.
pub fn gather(
    mesh: &PatchMesh,
    radiosity: &Field,
    method: &mut dyn FormFactors,
    sites: &[Viewpoint],
    settings: &GatherSettings,
    progress: &dyn Progress,
) -> Result<Gathered, FormFactorError> {
    let centroids: Vec<Vec3> = mesh.elements.iter().map(|element| mesh.centroid(element)).collect();
    let go_on = || {
        progress.rest();
        !progress.is_cancelled()
    };
    let mut gathered = Gathered::nothing(sites.len(), radiosity.num_groups());
    let mut cache = IrradianceCache::new(settings.tolerance, settings.max_radius);
    let order = scattered_order(sites.len());
    let mut next = 0;
    while next < order.len() && !progress.is_cancelled() {
        // Choose the next sites that no hemicube near them serves.
        let mut chosen = Vec::with_capacity(ROUND);
        while chosen.len() < ROUND && next < order.len() {
            let site = order[next];
            if !cache.serves(&sites[site as usize]) {
                chosen.push(site);
            }
            next += 1;
        }
        let viewpoints: Vec<Viewpoint> = chosen.iter().map(|&site| sites[site as usize]).collect();
        let sights =
            map_rows(method, &viewpoints, &go_on, |index, row| see(row, &viewpoints[index], radiosity, &centroids))?;
        for ((&site, viewpoint), sight) in chosen.iter().zip(&viewpoints).zip(&sights) {
            gathered.enter(site as usize, sight);
            if sight.back <= MAX_BACK_SHARE && settings.tolerance > 0.0 {
                cache.insert(viewpoint, sight.distance, sight.nearest, site);
            }
        }
        progress.report(Stage::Gather, next as f32 / order.len() as f32);
    }
    gathered.blend(sites, &cache);
    gathered.mean_back_share /= gathered.num_hemicubes.max(1) as f32;
    Ok(gathered)
}

/// All sites in an order that covers the scene evenly from the start.
fn scattered_order(num_sites: usize) -> Vec<u32> {
    let mut order: Vec<u32> = (0..num_sites as u32).collect();
    order.sort_by_key(|&site| hash(site));
    order
}

/// Irradiance, back faces and harmonic mean distance from one row.
fn see(row: &Row, viewpoint: &Viewpoint, radiosity: &Field, centroids: &[Vec3]) -> Sight {
    let mut irradiance = vec![Vec3::ZERO; radiosity.num_groups()];
    let (mut inverse_distance, mut seen, mut nearest) = (0.0, 0.0, f32::MAX);
    for entry in &row.entries {
        let element = entry.element.index();
        for (sum, &radiosity) in irradiance.iter_mut().zip(radiosity.at(element)) {
            *sum += entry.factor * radiosity;
        }
        let distance = centroids[element].distance(viewpoint.position);
        inverse_distance += entry.factor * distance.recip();
        nearest = distance.min(nearest);
        seen += entry.factor;
    }
    let distance = if inverse_distance > 0.0 { seen / inverse_distance } else { f32::MAX };
    Sight { irradiance, back: row.back, distance, nearest }
}

impl Gathered {
    /// No site is known.
    #[must_use]
    pub fn nothing(num_sites: usize, num_groups: usize) -> Self {
        Self {
            indirect: Field::zero(num_sites, num_groups),
            is_valid: vec![true; num_sites],
            is_known: vec![false; num_sites],
            mean_back_share: 0.0,
            num_hemicubes: 0,
        }
    }

    fn enter(&mut self, site: usize, sight: &Sight) {
        self.indirect.at_mut(site).copy_from_slice(&sight.irradiance);
        self.is_known[site] = true;
        self.is_valid[site] = sight.back <= MAX_BACK_SHARE;
        self.mean_back_share += sight.back;
        self.num_hemicubes += 1;
    }

    /// Gives every site the weighted mean of the records near it, its own included.
    fn blend(&mut self, sites: &[Viewpoint], cache: &IrradianceCache) {
        let own = self.indirect.clone();
        let mut weights = Vec::new();
        for (site, viewpoint) in sites.iter().enumerate().filter(|(site, _)| self.is_valid[*site]) {
            cache.weights(viewpoint, &mut weights);
            if weights.is_empty() {
                continue;
            }
            self.is_known[site] = true;
            let sums = self.indirect.at_mut(site);
            sums.fill(Vec3::ZERO);
            for &(record, weight) in &weights {
                sums.iter_mut().zip(own.at(record as usize)).for_each(|(sum, &value)| *sum += value * weight);
            }
        }
    }
}
