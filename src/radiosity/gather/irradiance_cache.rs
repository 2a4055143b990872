//! Irradiance cache: indirect irradiance varies slowly, so it is computed at sparse points and interpolated between
//! them.
//!
//! Ward's split-sphere model bounds how fast irradiance can change. If half of the surrounding sphere at distance R is
//! bright and half dark, the relative change between a record i and a point x is at most
//!
//! error_i(x) = |x - x_i| / R_i + sqrt(1 - n . n_i)
//!
//! (translation, then rotation; the constant factors are dropped). R_i is the harmonic mean distance of the surfaces in
//! the record's view, R = 1 / (sum of F / r): short in corners, long in the open. A point needs no record of its own if
//! one with error below the tolerance exists. Interpolation uses records up to twice that error, so each point blends
//! several and the border of a record's neighbourhood stays invisible.
//!
//! Source: Ward, Rubinstein, Clear 1988, "A ray tracing solution for diffuse interreflection".

use glam::{IVec3, Vec3};
use rustc_hash::FxHashMap;

use crate::form_factor::Viewpoint;

/// Largest error at which a record is still blended, as a multiple of the tolerance.
const BLEND: f32 = 2.0;

/// Smallest radius of a record, as a share of the largest: finer detail in corners than the mesh can show is not
/// needed.
const SMALLEST: f32 = 1.0 / 64.0;

/// Largest distances of an interpolated point in front of a record and behind it, as shares of the record's radius.
const IN_FRONT: f32 = 0.5;
const BEHIND: f32 = 0.1;

/// A point whose irradiance is known.
#[derive(Clone, Copy, Debug)]
struct Record {
    position: Vec3,
    normal: Vec3,
    /// Distance at which the error reaches the tolerance, metres.
    radius: f32,
    /// Number that the caller gave the record.
    index: u32,
}

/// Level of the finest grid: the number of halvings of the largest radius. All records with smaller radii are also in
/// this grid.
const MAX_LEVEL: usize = 15;

/// Records in grids whose cell size halves from level to level. Each record is in the grid whose cells are about as
/// large as its neighbourhood.
#[derive(Debug)]
pub(super) struct IrradianceCache {
    /// Error up to which a record suffices.
    tolerance: f32,
    max_radius: f32,
    levels: Vec<FxHashMap<IVec3, Vec<Record>>>,
}

impl IrradianceCache {
    /// An empty cache; the radius of a record is at most `max_radius` metres.
    pub fn new(tolerance: f32, max_radius: f32) -> Self {
        Self { tolerance, max_radius, levels: Vec::new() }
    }

    /// Adds the record `index`: a viewpoint that sees surfaces at harmonic mean distance `distance`, the nearest at
    /// `nearest`. The record's neighbourhood ends before the nearest surface, because light beyond it may be different,
    /// as under a shelf.
    pub fn insert(&mut self, viewpoint: &Viewpoint, distance: f32, nearest: f32, index: u32) {
        let within = (nearest / BLEND).max(SMALLEST * self.max_radius);
        let radius = (distance * self.tolerance).min(self.max_radius).min(within);
        let record = Record { position: viewpoint.position, normal: viewpoint.normal, radius, index };
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

    /// Returns true if a record is so close that `viewpoint` needs no record of its own.
    pub fn covers(&self, viewpoint: &Viewpoint) -> bool {
        self.nearby(viewpoint).any(|record| self.error(record, viewpoint).is_some_and(|error| error < self.tolerance))
    }

    /// Sets `weights` to the records between which `viewpoint` interpolates, with weights that sum to 1; empty if
    /// there are no such records.
    ///
    /// Equation: w = (1 - error / (2 tolerance))^2, error as above.
    pub fn weights(&self, viewpoint: &Viewpoint, weights: &mut Vec<(u32, f32)>) {
        weights.clear();
        for record in self.nearby(viewpoint) {
            if let Some(error) = self.error(record, viewpoint) {
                let closeness = 1.0 - error / (BLEND * self.tolerance);
                weights.push((record.index, closeness * closeness));
            }
        }
        let sum: f32 = weights.iter().map(|(_, weight)| weight).sum();
        weights.iter_mut().for_each(|(_, weight)| *weight /= sum);
    }

    /// Returns the records whose neighbourhood may contain the viewpoint.
    fn nearby<'c>(&'c self, viewpoint: &'c Viewpoint) -> impl Iterator<Item = &'c Record> {
        let in_cell =
            |level: usize| self.levels[level].get(&self.cell(level, viewpoint.position)).into_iter().flatten();
        (0..self.levels.len()).flat_map(in_cell)
    }

    /// Returns the cell of a position. Cells of a level are at least as wide as the neighbourhoods in it.
    fn cell(&self, level: usize, position: Vec3) -> IVec3 {
        let width = 2.0 * BLEND * self.max_radius / (1u32 << level) as f32;
        (position / width).floor().as_ivec3()
    }

    /// Returns the error of a record at a viewpoint, or `None` if it is too large to blend, or if one of the two may
    /// see surfaces hidden from the other.
    fn error(&self, record: &Record, viewpoint: &Viewpoint) -> Option<f32> {
        let offset = viewpoint.position - record.position;
        let error = offset.length() * self.tolerance / record.radius
            + (1.0 - viewpoint.normal.dot(record.normal)).max(0.0).sqrt();
        // A point in front of the record may see surfaces that are hidden from the record, and a record in front of the
        // point may lie on the surface that blocks the point's view.
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
    fn a_point_between_two_records_interpolates_both() {
        let mut cache = IrradianceCache::new(0.2, 1.0);
        cache.insert(&viewpoint(0.0, Vec3::Y), 1.0, 1.0, 7);
        cache.insert(&viewpoint(0.2, Vec3::Y), 1.0, 1.0, 8);
        let found = weights(&cache, &viewpoint(0.1, Vec3::Y));
        assert_eq!(found.iter().map(|(index, _)| *index).collect::<Vec<_>>(), [7, 8]);
        assert!(found.iter().all(|(_, weight)| (weight - 0.5).abs() < 1e-4), "{found:?}");
    }

    #[test]
    fn records_far_away_or_round_a_corner_have_no_weight() {
        let mut cache = IrradianceCache::new(0.2, 1.0);
        cache.insert(&viewpoint(0.0, Vec3::Y), 1.0, 1.0, 7);
        assert!(weights(&cache, &viewpoint(0.41, Vec3::Y)).is_empty());
        assert!(weights(&cache, &viewpoint(0.0, Vec3::X)).is_empty());
        assert!(!weights(&cache, &viewpoint(0.39, Vec3::Y)).is_empty());
        assert!(cache.covers(&viewpoint(0.19, Vec3::Y)) && !cache.covers(&viewpoint(0.21, Vec3::Y)));
    }
}
