//! The size of pictures of a movement on a software driver: full size if a picture is fast enough, else half the width
//! and height if that is faster.

/// Longest time of a full-size picture, seconds; slower ones are halved.
const SLOWEST: f32 = 0.016;
/// Half size is used if its pictures take less than this fraction of the time of full-size ones.
const GAIN: f32 = 0.9;
/// Factor that makes a limit stricter, so that the size does not change back and forth: it multiplies `SLOWEST` for a
/// change to full size, and `GAIN` for a change to half size.
const CAUTION: f32 = 0.9;
/// Number of half-size pictures after which one is drawn at full size, to measure its time again. A size is kept for at
/// least as many pictures.
const PROBE: u32 = 60;
/// Weights of the newest picture in the mean: the first if it is slower than the mean, the second if it is faster. A
/// picture may be slow for other reasons, so the first weight is smaller.
const SMOOTHING: [f32; 2] = [0.2, 0.5];

/// Chooses the size by the times of the pictures so far.
#[derive(Debug, Default)]
pub struct SketchSize {
    is_halved: bool,
    /// Pictures since the size changed.
    num_pictures: u32,
    full: Times,
    half: Times,
}

/// Times of the pictures of one size.
#[derive(Debug, Default)]
struct Times {
    /// True after the first picture. Its time does not count, because it allocates what the next ones reuse.
    is_warm: bool,
    /// Mean time of the other pictures, seconds.
    mean: Option<f32>,
}

impl Times {
    fn note(&mut self, seconds: f32) {
        let next = |mean: f32| mean + SMOOTHING[usize::from(seconds < mean)] * (seconds - mean);
        if std::mem::replace(&mut self.is_warm, true) {
            self.mean = Some(self.mean.map_or(seconds, next));
        }
    }
}

impl SketchSize {
    /// Returns true if the next picture of a movement is drawn at full size.
    #[must_use]
    pub fn is_full(&self) -> bool {
        !self.is_halved || self.num_pictures % PROBE == PROBE - 1
    }

    /// Records the time of a picture of a movement, seconds.
    pub fn note(&mut self, seconds: f32) {
        let times = if self.is_full() { &mut self.full } else { &mut self.half };
        times.note(seconds);
        let (slowest, gain) = if self.is_halved { (CAUTION * SLOWEST, GAIN) } else { (SLOWEST, CAUTION * GAIN) };
        let is_slow = self.full.mean.is_some_and(|full| full > slowest);
        let helps = self.half.mean.zip(self.full.mean).is_none_or(|(half, full)| half < gain * full);
        self.num_pictures += 1;
        let may_change = self.half.mean.is_none() || self.num_pictures >= PROBE;
        if may_change && self.is_halved != (is_slow && helps) {
            (self.is_halved, self.num_pictures) = (!self.is_halved, 0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Draws 300 pictures that take `full` or `half` seconds, depending on their size. Returns the share of full-size
    /// pictures among the last hundred.
    fn share_of_full(size: &mut SketchSize, full: f32, half: f32) -> f32 {
        let mut next = || {
            let is_full = size.is_full();
            size.note(if is_full { full } else { half });
            is_full
        };
        let sizes: Vec<bool> = (0..300).map(|_| next()).collect();
        sizes[200..].iter().filter(|is_full| **is_full).count() as f32 / 100.0
    }

    #[test]
    fn pictures_are_full_size_if_there_is_time_or_halving_does_not_help() {
        assert_eq!(share_of_full(&mut SketchSize::default(), 0.012, 0.005), 1.0);
        assert_eq!(share_of_full(&mut SketchSize::default(), 0.040, 0.036), 1.0);
        assert!(share_of_full(&mut SketchSize::default(), 0.040, 0.015) < 0.03);
    }

    #[test]
    fn pictures_become_full_size_again_when_there_is_time() {
        let mut size = SketchSize::default();
        share_of_full(&mut size, 0.040, 0.015);
        for _ in 0..2 {
            share_of_full(&mut size, 0.010, 0.004);
        }
        assert_eq!(share_of_full(&mut size, 0.010, 0.004), 1.0);
    }

    #[test]
    fn one_late_picture_changes_nothing() {
        let mut size = SketchSize::default();
        for seconds in [0.010, 0.010, 0.030, 0.010, 0.010] {
            size.note(seconds);
            assert!(size.is_full());
        }
    }
}
