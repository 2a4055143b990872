//! Light samples in batches: while nothing moves, pictures with a few samples each add up to one with many.

use super::light_samples::LightSample;

/// Points on each lamp that all batches have together.
pub const MOST_POINTS: u32 = 256;

/// What one picture adds to those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Batch {
    /// Number of the batch, from 0 on.
    pub number: u32,
    /// First of its light samples that are added now; 0 in batch 0 begins a new sum.
    pub first: usize,
    /// How many are added; until the last of the batch is, no picture comes of it.
    pub count: usize,
}

impl Batch {
    /// A whole batch.
    #[must_use]
    pub fn whole(number: u32) -> Self {
        Self { number, first: 0, count: usize::MAX }
    }

    /// Nothing was added before it.
    #[must_use]
    pub fn is_first(self) -> bool {
        self.number == 0 && self.first == 0
    }
}

/// Batches of `per_lamp` points each, a power of two.
#[must_use]
pub fn num_batches(per_lamp: u32) -> u32 {
    MOST_POINTS / per_lamp.next_power_of_two().clamp(1, MOST_POINTS)
}

/// Of `all` samples of a scene, [`MOST_POINTS`] a lamp, those of one batch, as strong as all together: the mean over all
/// batches is the light of all. After any number of batches the points so far are spread evenly.
#[must_use]
pub fn batch_of_samples(all: &[LightSample], per_lamp: u32, number: u32) -> Vec<LightSample> {
    let count = num_batches(per_lamp);
    // Reversed bits jump about (van der Corput 1935).
    let wanted = if count == 1 { 0 } else { number.reverse_bits() >> (32 - count.trailing_zeros()) };
    let mut batch = Vec::new();
    for lamp in all.chunk_by(|a, b| a.lamp == b.lamp) {
        if lamp.len() == 1 {
            batch.extend_from_slice(lamp);
            continue;
        }
        for sample in lamp.iter().skip(wanted as usize).step_by(count as usize) {
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
    use crate::render::shadow::light_samples;
    use crate::scene::builtin;
    use glam::Vec3;

    #[test]
    fn all_batches_together_are_all_samples() {
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
    fn no_point_comes_twice() {
        let all = light_samples(&builtin::cornell(), MOST_POINTS, 0.0);
        let mut places: Vec<_> = (0..num_batches(8))
            .flat_map(|number| batch_of_samples(&all, 8, number))
            .map(|sample| sample.place().to_array().map(f32::to_bits))
            .collect();
        places.sort_unstable();
        places.dedup();
        assert_eq!(places.len(), MOST_POINTS as usize);
    }
}
