//! The sampling noise of gathered light, and how many hemicubes one viewpoint needs.
//!
//! If the light of a viewpoint comes from few small bright surfaces, samples hit or miss them by chance. The resulting
//! noise is visible even on a plain wall. There, several hemicubes with different seeds are averaged.
//!
//! The number for a viewpoint follows from its neighbours and not from its own samples. A hemicube that misses a bright
//! surface estimates a variance of zero, and to stop because of that would lose light (bias of adaptive sampling: Kirk,
//! Arvo 1991).

use glam::IVec3;
use rustc_hash::FxHashMap;

use crate::base::colour::luminance;
use crate::form_factor::{Row, Viewpoint};
use crate::radiosity::field::Field;

/// Largest number of hemicubes per viewpoint.
const MAX_HEMICUBES: u32 = 16;

/// Noise is relative to at least this share of the mean irradiance, because noise in the dark is invisible.
const FLOOR: f64 = 0.1;

/// Neighbouring samples count as one object if their radiosities differ by less than this factor.
const SIMILAR: f32 = 2.0;

/// Cell of a position, and of a normal.
type Cell = (IVec3, IVec3);

/// The noise of the hemicubes so far, cell by cell.
#[derive(Debug)]
pub(super) struct SamplingNoise {
    /// Accepted standard deviation, relative to the irradiance.
    tolerance: f32,
    /// Width of a cell, metres.
    width: f32,
    cells: FxHashMap<Cell, Sums>,
    /// Sums over all cells.
    all: Sums,
}

/// Sums over hemicubes.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    count: f64,
    irradiance: f64,
    variance: f64,
}

impl Sums {
    fn add(&mut self, irradiance: f32, variance: f32) {
        self.count += 1.0;
        self.irradiance += f64::from(irradiance);
        self.variance += f64::from(variance);
    }

    fn mean_irradiance(&self) -> f64 {
        self.irradiance / self.count
    }
}

impl SamplingNoise {
    /// Creates a record of noise without hemicubes. Viewpoints within a cell of `width` metres count as equally noisy.
    pub fn new(tolerance: f32, width: f32) -> Self {
        Self { tolerance, width, cells: FxHashMap::default(), all: Sums::default() }
    }

    /// Returns the number of hemicubes whose mean has the accepted noise at a viewpoint, or 1 if its cell has none yet.
    pub fn num_hemicubes(&self, viewpoint: &Viewpoint) -> u32 {
        let Some(sums) = self.cells.get(&self.cell(viewpoint)) else { return 1 };
        let irradiance = sums.mean_irradiance().max(FLOOR * self.all.mean_irradiance());
        let tolerated = (f64::from(self.tolerance) * irradiance).powi(2).max(f64::MIN_POSITIVE);
        // An infinite variance divided by an infinite tolerance is NaN, which the cast turns into 0: one hemicube.
        ((sums.variance / sums.count / tolerated).round() as u32).clamp(1, MAX_HEMICUBES)
    }

    /// Adds the irradiance from one hemicube, and its variance.
    pub fn add(&mut self, viewpoint: &Viewpoint, irradiance: f32, variance: f32) {
        let cell = self.cell(viewpoint);
        self.cells.entry(cell).or_default().add(irradiance, variance);
        self.all.add(irradiance, variance);
    }

    fn cell(&self, viewpoint: &Viewpoint) -> Cell {
        ((viewpoint.position / self.width).floor().as_ivec3(), viewpoint.normal.round().as_ivec3())
    }
}

/// Returns the luminance of the irradiance from `radiosity` `[e][g]` through a row of `num_samples` samples, and its
/// variance.
///
/// Let N be the number of samples and F = n / N the form factor of an object that n of them hit. Of these, only those
/// near the object's outline hit or miss it by chance: about sqrt(n). Each chance hit changes the estimate by
/// contrast / N, where contrast is the object's radiosity less the mean. So the object adds
/// sqrt(n) (contrast / N)^2 = contrast^2 sqrt(F / N) / N to the variance.
#[must_use]
pub fn irradiance_and_variance(row: &Row, radiosity: &Field, num_samples: f32) -> (f32, f32) {
    let seen: f32 = row.entries.iter().map(|entry| entry.factor).sum();
    let brightness = |e: usize| luminance(radiosity.total(e));
    let irradiance: f32 = row.entries.iter().map(|entry| entry.factor * brightness(entry.element.index())).sum();
    let mean = irradiance / seen.max(f32::MIN_POSITIVE);
    let (mut variance, mut factor, mut flux) = (0.0, 0.0, 0.0);
    let mut end = |factor: f32, flux: f32| {
        if factor > 0.0 {
            let contrast = flux / factor - mean;
            variance += contrast * contrast * (factor / num_samples).sqrt() / num_samples;
        }
    };
    for entry in &row.entries {
        let brightness = brightness(entry.element.index());
        if brightness * factor > SIMILAR * flux || brightness * factor * SIMILAR < flux {
            end(factor, flux);
            (factor, flux) = (0.0, 0.0);
        }
        factor += entry.factor;
        flux += entry.factor * brightness;
    }
    end(factor, flux);
    (irradiance, variance)
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn neighbours_decide_how_many_hemicubes_a_viewpoint_has() {
        let viewpoint = |x: f32, normal: Vec3| Viewpoint { position: Vec3::new(x, 0.1, 0.1), normal, seed: 0 };
        let mut noise = SamplingNoise::new(0.1, 1.0);
        noise.add(&viewpoint(0.2, Vec3::Y), 3.0, 0.05);
        noise.add(&viewpoint(0.4, Vec3::Y), 1.0, 0.27);
        assert_eq!(noise.num_hemicubes(&viewpoint(0.8, Vec3::Y)), 4);
        assert_eq!(noise.num_hemicubes(&viewpoint(1.2, Vec3::Y)), 1, "too far away");
        assert_eq!(noise.num_hemicubes(&viewpoint(0.8, Vec3::X)), 1, "faces another way");
        noise.add(&viewpoint(1.5, Vec3::Y), 2.0, 4.0);
        assert_eq!(noise.num_hemicubes(&viewpoint(1.2, Vec3::Y)), 16, "never more than the limit");
    }

    #[test]
    fn an_infinite_variance_gives_a_number_of_hemicubes_within_the_limits() {
        let viewpoint = Viewpoint { position: Vec3::ZERO, normal: Vec3::Y, seed: 0 };
        let mut noise = SamplingNoise::new(0.1, 1.0);
        noise.add(&viewpoint, 1e25, f32::INFINITY);
        assert!((1..=16).contains(&noise.num_hemicubes(&viewpoint)));
    }
}
