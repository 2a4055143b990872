//! How large pictures are drawn while something moves, where the processor draws: as large as they are shown, if they are done
//! in time, else half as wide and high, if that helps.

/// Full-size pictures that take longer are halved, seconds.
const SLOWEST: f32 = 0.016;
/// Half-size pictures that take more than this share of the time of full ones help nobody.
const GAIN: f32 = 0.9;
/// Both limits are so much closer for a change than for going on.
const CAUTION: f32 = 0.9;
/// Among so many half-size pictures one is full, to see how long it takes by now; for as long a size is kept.
const PROBE: u32 = 60;
/// Share of the newest picture in the mean, where it is slower, as it may be for other reasons, and where it is faster.
const SMOOTHING: [f32; 2] = [0.2, 0.5];

/// Decides by the pictures so far.
#[derive(Debug, Default)]
pub struct Motion {
    is_halved: bool,
    /// Pictures since that changed.
    num_pictures: u32,
    full: Times,
    half: Times,
}

/// Times of the pictures of one size.
#[derive(Debug, Default)]
struct Times {
    /// There was a first one, which does not count: it makes what the next ones find.
    is_warm: bool,
    /// Mean of the others, seconds.
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

impl Motion {
    /// Whether the next picture of a movement is drawn as large as it is shown.
    #[must_use]
    pub fn is_full(&self) -> bool {
        !self.is_halved || self.num_pictures % PROBE == PROBE - 1
    }

    /// The picture of a movement took so long, seconds.
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

    /// Shares of full pictures among the last of 300 where one takes `full` seconds and a half-size one `half`.
    fn share_of_full(motion: &mut Motion, full: f32, half: f32) -> f32 {
        let mut next = || {
            let is_full = motion.is_full();
            motion.note(if is_full { full } else { half });
            is_full
        };
        let sizes: Vec<bool> = (0..300).map(|_| next()).collect();
        sizes[200..].iter().filter(|is_full| **is_full).count() as f32 / 100.0
    }

    #[test]
    fn pictures_are_full_where_there_is_time_and_where_halving_does_not_help() {
        assert_eq!(share_of_full(&mut Motion::default(), 0.012, 0.005), 1.0);
        assert_eq!(share_of_full(&mut Motion::default(), 0.040, 0.036), 1.0);
        assert!(share_of_full(&mut Motion::default(), 0.040, 0.015) < 0.03);
    }

    #[test]
    fn pictures_grow_again_when_there_is_time() {
        let mut motion = Motion::default();
        share_of_full(&mut motion, 0.040, 0.015);
        for _ in 0..2 {
            share_of_full(&mut motion, 0.010, 0.004);
        }
        assert_eq!(share_of_full(&mut motion, 0.010, 0.004), 1.0);
    }

    #[test]
    fn one_late_picture_changes_nothing() {
        let mut motion = Motion::default();
        for seconds in [0.010, 0.010, 0.030, 0.010, 0.010] {
            motion.note(seconds);
            assert!(motion.is_full());
        }
    }
}
