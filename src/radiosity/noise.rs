//! How noisy gathered light is: where a place sees little but bright things, samples that hit or miss them leave a noise that
//! the eye finds on an even wall. There, several looks are taken and their mean is kept.
//!
//! What one look finds must not decide how many are taken at its own place: looks that miss a bright thing would seem exact,
//! and light would be lost. The places round it decide.

use glam::IVec3;
use rustc_hash::FxHashMap;

use super::field::Field;
use crate::base::colour::luminance;
use crate::form_factor::{Row, Viewpoint};

/// Most looks that one place is worth.
const MAX_LOOKS: u32 = 16;

/// Irradiance that noise is measured beside even in the dark, as a share of the mean.
const FLOOR: f64 = 0.1;

/// Neighbouring samples see the same thing where their radiosities differ by less than this factor.
const ALIKE: f32 = 2.0;

/// Cells of places that face the same way.
type Cell = (IVec3, IVec3);

/// How noisy what was met so far is, place by place.
#[derive(Debug)]
pub struct Noise {
    /// Standard deviation that is let be, relative to the irradiance.
    tolerance: f32,
    /// Width of a cell, metres.
    width: f32,
    cells: FxHashMap<Cell, Met>,
    /// All cells together.
    all: Met,
}

/// Sums over looks.
#[derive(Clone, Copy, Debug, Default)]
struct Met {
    num_looks: f64,
    irradiance: f64,
    variance: f64,
}

impl Met {
    fn add(&mut self, irradiance: f32, variance: f32) {
        self.num_looks += 1.0;
        self.irradiance += f64::from(irradiance);
        self.variance += f64::from(variance);
    }

    fn mean_irradiance(&self) -> f64 {
        self.irradiance / self.num_looks
    }
}

impl Noise {
    /// Nothing is known of any place; those within `width` metres are taken for equally noisy.
    #[must_use]
    pub fn new(tolerance: f32, width: f32) -> Self {
        Self { tolerance, width, cells: FxHashMap::default(), all: Met::default() }
    }

    /// How many looks bring the noise at a place down to the tolerance.
    #[must_use]
    pub fn looks(&self, viewpoint: &Viewpoint) -> u32 {
        let Some(met) = self.cells.get(&self.cell(viewpoint)) else { return 1 };
        let irradiance = met.mean_irradiance().max(FLOOR * self.all.mean_irradiance());
        let tolerated = (f64::from(self.tolerance) * irradiance).powi(2).max(f64::MIN_POSITIVE);
        // Of light too bright for its variance to be a number the cast makes 0: one look.
        ((met.variance / met.num_looks / tolerated).round() as u32).clamp(1, MAX_LOOKS)
    }

    /// Enters the irradiance that one look found at a place, and its variance.
    pub fn learn(&mut self, viewpoint: &Viewpoint, irradiance: f32, variance: f32) {
        let cell = self.cell(viewpoint);
        self.cells.entry(cell).or_default().add(irradiance, variance);
        self.all.add(irradiance, variance);
    }

    fn cell(&self, viewpoint: &Viewpoint) -> Cell {
        ((viewpoint.position / self.width).floor().as_ivec3(), viewpoint.normal.round().as_ivec3())
    }
}

/// Luminous irradiance that `radiosity` `[e][g]` brings through a row of `num_samples` samples, and its variance.
///
/// Of n evenly spread samples that see one thing only those on its outline hit or miss it by chance: their number has the
/// variance sqrt(n), and each is worth how much brighter the thing is than the mean.
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
        if brightness * factor > ALIKE * flux || brightness * factor * ALIKE < flux {
            end(factor, flux);
            (factor, flux) = (0.0, 0.0);
        }
        factor += entry.factor;
        flux += entry.factor * brightness;
    }
    end(factor, flux);
    (irradiance, variance)
}
