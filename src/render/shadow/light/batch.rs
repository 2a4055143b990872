//! Batches of light samples. While nothing moves, each picture draws a few samples, and the sum approaches a picture
//! with many.

use super::sample::LightSample;

/// Number of samples per lamp in all batches together.
pub const MOST_POINTS: u32 = 256;

/// The light samples that one picture adds to the sum of the previous pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleBatch {
    /// Number of the batch, from 0.
    pub number: u32,
    /// First light sample of the batch that this picture adds. In batch 0, sample 0 begins a new sum.
    pub first: usize,
    /// Number of light samples that this picture adds. A picture is shown when the last sample of the batch has been
    /// added.
    pub count: usize,
}

impl SampleBatch {
    /// Returns all light samples of a batch.
    #[must_use]
    pub fn whole(number: u32) -> Self {
        Self { number, first: 0, count: usize::MAX }
    }

    /// Returns true if this begins a new sum.
    #[must_use]
    pub fn is_first(self) -> bool {
        self.number == 0 && self.first == 0
    }
}

/// Returns the number of batches of `per_lamp` samples (rounded up to a power of two) that make up [`MOST_POINTS`].
#[must_use]
pub fn num_batches(per_lamp: u32) -> u32 {
    MOST_POINTS / per_lamp.next_power_of_two().clamp(1, MOST_POINTS)
}

/// Selects the samples of one batch from `all` samples of a scene, [`MOST_POINTS`] per lamp.
///
/// Each batch is as strong as all samples together, so the mean over all batches is the light of all samples. Batches
/// come in van der Corput order, which spreads the samples of the first few evenly over a lamp.
#[must_use]
pub fn batch_of_samples(all: &[LightSample], per_lamp: u32, number: u32) -> Vec<LightSample> {
    let count = num_batches(per_lamp);
    // Radical inverse in base 2: the reversed bits of the number (van der Corput 1935).
    let first = if count == 1 { 0 } else { number.reverse_bits() >> (32 - count.trailing_zeros()) };
    let mut batch = Vec::new();
    for lamp in all.chunk_by(|a, b| a.lamp == b.lamp) {
        if lamp.len() == 1 {
            batch.extend_from_slice(lamp);
            continue;
        }
        for sample in lamp.iter().skip(first as usize).step_by(count as usize) {
            let mut sample = sample.clone();
            sample.light.intensity *= count as f32;
            batch.push(sample);
        }
    }
    batch
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::shadow::light::samples::light_samples;
    use crate::scene::builtin;
    use glam::Vec3;

    #[test]
    fn the_mean_of_all_batches_is_the_light_of_all_samples() {
        let scene = builtin::gallery();
        let all = light_samples(&scene, MOST_POINTS, 0.0);
        let (point, normal) = (Vec3::new(0.3, 0.1, 0.2), Vec3::Y);
        let sum = |samples: &[LightSample]| samples.iter().map(|s| s.irradiance(point, normal)).sum::<Vec3>();
        for per_lamp in [1, 16, 64, 256] {
            let count = num_batches(per_lamp);
            assert_eq!(count * per_lamp, MOST_POINTS);
            let batches = (0..count).map(|number| sum(&batch_of_samples(&all, per_lamp, number)));
            let mean = batches.sum::<Vec3>() / count as f32;
            assert!((mean / sum(&all) - 1.0).abs().max_element() < 1e-4, "{per_lamp}: {mean}, not {}", sum(&all));
        }
    }

    #[test]
    fn batches_share_no_point() {
        let all = light_samples(&builtin::cornell(), MOST_POINTS, 0.0);
        let mut positions: Vec<_> = (0..num_batches(8))
            .flat_map(|number| batch_of_samples(&all, 8, number))
            .map(|sample| sample.position().to_array().map(f32::to_bits))
            .collect();
        positions.sort_unstable();
        positions.dedup();
        assert_eq!(positions.len(), MOST_POINTS as usize);
    }
}
