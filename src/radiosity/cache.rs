//! Irradiance cache: indirect light varies slowly, so a site near one that is known can borrow from it.
//!
//! Each known site is good for a neighbourhood that grows with the harmonic mean distance of what it sees: small in corners,
//! large in the open. The normal tells the other half of the error. Sites are looked for within the tolerance, but blended
//! from twice as far, so that every place is a mean of several and no neighbourhood shows its border.
//!
//! Source: Ward, Rubinstein, Clear 1988, "A ray tracing solution for diffuse interreflection".

use glam::{IVec3, Vec3};
use rustc_hash::FxHashMap;

use crate::form_factor::Viewpoint;

/// How much farther sites are blended from than looked for.
const BLEND: f32 = 2.0;

/// Smallest neighbourhood, as a share of the largest: corners need no finer detail than the mesh shows.
const SMALLEST: f32 = 1.0 / 64.0;

/// How far in front of a record, and behind it, a place may lie, as a share of its neighbourhood.
const IN_FRONT: f32 = 0.5;
const BEHIND: f32 = 0.1;

/// A site whose irradiance is known.
#[derive(Clone, Copy, Debug)]
struct Record {
    position: Vec3,
    normal: Vec3,
    /// Farthest that it is good for within the tolerance, metres.
    radius: f32,
    site: u32,
}

/// Finest grid: records smaller than this many halvings of the largest share its cells.
const MAX_LEVEL: usize = 15;

/// Known sites in grids of ever smaller cells, each record in one whose cells are about as large as its neighbourhood.
#[derive(Debug)]
pub struct IrradianceCache {
    /// Largest error at which a record may be borrowed from.
    tolerance: f32,
    max_radius: f32,
    levels: Vec<FxHashMap<IVec3, Vec<Record>>>,
}

impl IrradianceCache {
    /// An empty cache; records reach at most `max_radius` metres.
    #[must_use]
    pub fn new(tolerance: f32, max_radius: f32) -> Self {
        Self { tolerance, max_radius, levels: Vec::new() }
    }

    /// Enters a known site that sees surfaces at harmonic mean distance `distance`, the nearest at `nearest`: it is good
    /// for no place beyond that one, which may be under a shelf that the site sees from outside.
    pub fn insert(&mut self, viewpoint: &Viewpoint, distance: f32, nearest: f32, site: u32) {
        let within = (nearest / BLEND).max(SMALLEST * self.max_radius);
        let radius = (distance * self.tolerance).min(self.max_radius).min(within);
        let record = Record { position: viewpoint.position, normal: viewpoint.normal, radius, site };
        let halvings = (self.max_radius / radius.max(f32::MIN_POSITIVE)).log2();
        let level = (halvings.max(0.0) as usize).min(MAX_LEVEL);
        if self.levels.len() <= level {
            self.levels.resize_with(level + 1, FxHashMap::default);
        }
        let low = self.cell(level, viewpoint.position - BLEND * radius);
        let high = self.cell(level, viewpoint.position + BLEND * radius);
        for x in low.x..=high.x {
            for y in low.y..=high.y {
                for z in low.z..=high.z {
                    self.levels[level].entry(IVec3::new(x, y, z)).or_default().push(record);
                }
            }
        }
    }

    /// A known site is near enough for `viewpoint` to do without one of its own.
    #[must_use]
    pub fn serves(&self, viewpoint: &Viewpoint) -> bool {
        self.near(viewpoint).any(|record| self.error(record, viewpoint).is_some_and(|error| error < self.tolerance))
    }

    /// Known sites that `viewpoint` may borrow from, with weights that sum to 1; none where there are none.
    ///
    /// Equation: w = (1 - error / limit)^2 with error = |x - x_i| / R_i + sqrt(1 - n . n_i).
    pub fn weights(&self, viewpoint: &Viewpoint, weights: &mut Vec<(u32, f32)>) {
        weights.clear();
        for record in self.near(viewpoint) {
            if let Some(error) = self.error(record, viewpoint) {
                let closeness = 1.0 - error / (BLEND * self.tolerance);
                weights.push((record.site, closeness * closeness));
            }
        }
        let sum: f32 = weights.iter().map(|(_, weight)| weight).sum();
        weights.iter_mut().for_each(|(_, weight)| *weight /= sum);
    }

    /// Records whose neighbourhood may hold the viewpoint.
    fn near<'c>(&'c self, viewpoint: &'c Viewpoint) -> impl Iterator<Item = &'c Record> {
        let in_cell =
            |level: usize| self.levels[level].get(&self.cell(level, viewpoint.position)).into_iter().flatten();
        (0..self.levels.len()).flat_map(in_cell)
    }

    /// Cells of a level are at least as wide as the neighbourhoods in it.
    fn cell(&self, level: usize, position: Vec3) -> IVec3 {
        let width = 2.0 * BLEND * self.max_radius / (1u32 << level) as f32;
        (position / width).floor().as_ivec3()
    }

    fn error(&self, record: &Record, viewpoint: &Viewpoint) -> Option<f32> {
        let offset = viewpoint.position - record.position;
        let error = offset.length() * self.tolerance / record.radius
            + (1.0 - viewpoint.normal.dot(record.normal)).max(0.0).sqrt();
        // What a place in front of the record sees may be hidden from it, and a record in front of the place may lie on the
        // very thing that hides something from that.
        let height = offset.dot(viewpoint.normal + record.normal) * 0.5;
        let is_level = height < IN_FRONT * record.radius && -height < BEHIND * record.radius;
        (error < BLEND * self.tolerance && is_level).then_some(error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn viewpoint(x: f32, normal: Vec3) -> Viewpoint {
        Viewpoint { position: Vec3::new(x, 0.0, 0.0), normal, seed: 0 }
    }

    fn weights(cache: &IrradianceCache, viewpoint: &Viewpoint) -> Vec<(u32, f32)> {
        let mut weights = Vec::new();
        cache.weights(viewpoint, &mut weights);
        weights
    }

    #[test]
    fn a_place_between_two_records_borrows_from_both() {
        let mut cache = IrradianceCache::new(0.2, 1.0);
        cache.insert(&viewpoint(0.0, Vec3::Y), 1.0, 1.0, 7);
        cache.insert(&viewpoint(0.2, Vec3::Y), 1.0, 1.0, 8);
        let found = weights(&cache, &viewpoint(0.1, Vec3::Y));
        assert_eq!(found.iter().map(|(site, _)| *site).collect::<Vec<_>>(), [7, 8]);
        assert!(found.iter().all(|(_, weight)| (weight - 0.5).abs() < 1e-4), "{found:?}");
    }

    #[test]
    fn nothing_is_borrowed_from_afar_or_round_a_corner() {
        let mut cache = IrradianceCache::new(0.2, 1.0);
        cache.insert(&viewpoint(0.0, Vec3::Y), 1.0, 1.0, 7);
        assert!(weights(&cache, &viewpoint(0.41, Vec3::Y)).is_empty());
        assert!(weights(&cache, &viewpoint(0.0, Vec3::X)).is_empty());
        assert!(!weights(&cache, &viewpoint(0.39, Vec3::Y)).is_empty());
        assert!(cache.serves(&viewpoint(0.19, Vec3::Y)) && !cache.serves(&viewpoint(0.21, Vec3::Y)));
    }
}
