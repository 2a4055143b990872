//! Gathering: the indirect irradiance at every site, from one hemicube there over the solved elements.
//!
//! Source: Wallace, Elmquist, Haines 1989 (radiosity at vertices); Lischinski, Tampieri, Greenberg 1993 (final gather of
//! a radiosity solution).

use glam::Vec3;

use super::field::Field;
use crate::base::progress::{Progress, Stage};
use crate::form_factor::{FormFactorError, FormFactors, Viewpoint, map_rows};

/// A site that sees more back faces than this share lies inside something.
const MAX_BACK_SHARE: f32 = 0.4;

/// Indirect light at sites.
pub struct Gathered {
    /// Indirect irradiance [site][group], lux per channel; for the first sites only where it was cancelled.
    pub indirect: Field,
    /// The site lies on an open surface, not inside or behind a wall.
    pub is_valid: Vec<bool>,
    /// Share of back faces seen, mean over all sites.
    pub mean_back_share: f32,
}

/// Gathers the reflected `radiosity` [e][g] at all `sites`.
///
/// Equation: E = sum over elements of F(site, e) B_e.
///
/// # Errors
/// The form factors could not be found.
pub fn gather(
    radiosity: &Field,
    method: &mut dyn FormFactors,
    sites: &[Viewpoint],
    progress: &dyn Progress,
) -> Result<Gathered, FormFactorError> {
    let num_groups = radiosity.num_groups();
    let go_on = || {
        progress.rest();
        !progress.is_cancelled()
    };
    let gathered_at = |index: usize, row: &crate::form_factor::Row| {
        let mut irradiance = vec![Vec3::ZERO; num_groups];
        for entry in &row.entries {
            for (sum, &radiosity) in irradiance.iter_mut().zip(radiosity.at(entry.element.index())) {
                *sum += entry.factor * radiosity;
            }
        }
        if index.is_multiple_of(64) {
            progress.report(Stage::Gather, index as f32 / sites.len() as f32);
        }
        (irradiance, row.back)
    };
    let found = map_rows(method, sites, &go_on, gathered_at)?;
    let is_valid = found.iter().map(|(_, back)| *back <= MAX_BACK_SHARE).collect();
    let mean_back_share = found.iter().map(|(_, back)| back).sum::<f32>() / found.len().max(1) as f32;
    let values = found.into_iter().flat_map(|(irradiance, _)| irradiance).collect();
    Ok(Gathered { indirect: Field::from_values(num_groups, values), is_valid, mean_back_share })
}
