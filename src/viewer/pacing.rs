//! When frames are drawn: only when something has changed, never faster than the screen, and during a bake with pauses
//! in which the bake gets on.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use std::time::{Duration, Instant};

use anyhow::Context;

/// While baking, the pause after a frame as a share of the frame's own time, and at least [`SHORTEST_PAUSE`].
const PAUSE_SHARE: f32 = 0.25;
/// A bake gets at least this long between two frames.
const SHORTEST_PAUSE: Duration = Duration::from_millis(8);
/// Share of the newest frame in the shown frame time.
const SMOOTHING: f32 = 0.1;

/// Decides when the next frame is due, and keeps the times.
pub struct Pacer {
    /// Somebody asked for a frame then, and it has not been drawn yet.
    wanted: Option<Instant>,
    /// Shortest time between two frames.
    interval: Duration,
    begun: Instant,
    ended: Instant,
    /// The frame that is being drawn was wanted as soon as the last one was done.
    is_continuous: bool,
    frame_seconds: f32,
    last_seconds: f32,
    gap_seconds: f32,
    log: Option<BufWriter<File>>,
}

impl Pacer {
    /// A pacer for a screen with `refresh_rate` in hertz that logs to a file where one is named.
    ///
    /// # Errors
    /// The log cannot be written.
    pub fn new(refresh_rate: f32, log: Option<&Path>) -> anyhow::Result<Self> {
        let open = |path: &Path| {
            let file = File::create(path).with_context(|| format!("cannot write {}", path.display()))?;
            anyhow::Ok(BufWriter::new(file))
        };
        let now = Instant::now();
        Ok(Self {
            wanted: Some(now),
            // A little shorter than the screen's own interval, which then keeps the time.
            interval: Duration::from_secs_f32(0.8 / refresh_rate.max(1.0)),
            begun: now,
            ended: now,
            is_continuous: false,
            frame_seconds: 0.0,
            last_seconds: 0.0,
            gap_seconds: 0.0,
            log: log.map(open).transpose()?,
        })
    }

    /// Something has changed: a frame is wanted.
    pub fn want(&mut self) {
        self.wanted.get_or_insert_with(Instant::now);
    }

    /// When the wanted frame shall be drawn; none where none is wanted.
    #[must_use]
    pub fn due(&self, is_baking: bool) -> Option<Instant> {
        self.wanted?;
        let steady = self.begun + self.interval;
        if !is_baking {
            return Some(steady);
        }
        let pause = Duration::from_secs_f32(PAUSE_SHARE * self.frame_seconds).max(SHORTEST_PAUSE);
        Some(steady.max(self.ended + pause))
    }

    /// A frame begins; the seconds that motion shall cover.
    pub fn begin(&mut self) -> f32 {
        let now = Instant::now();
        self.is_continuous = self.wanted.is_some_and(|wanted| wanted <= self.ended + Duration::from_millis(1));
        let since = now - self.begun;
        self.begun = now;
        // The first frame of a movement has no frame before it to measure from.
        if self.is_continuous { since.as_secs_f32() } else { self.interval.as_secs_f32() }
    }

    /// The frame is on the screen. Logs `seconds baking` with the time from when the frame was wanted.
    pub fn end(&mut self, is_baking: bool) {
        let now = Instant::now();
        let wanted = self.wanted.take().unwrap_or(self.begun);
        // In continuous motion the frame was wanted when the last one was shown: this is the gap between the two.
        let gap = (now - wanted).as_secs_f32();
        self.last_seconds = (now - self.begun).as_secs_f32();
        smooth(&mut self.frame_seconds, self.last_seconds);
        if self.is_continuous {
            smooth(&mut self.gap_seconds, gap);
        }
        self.ended = now;
        if let Some(log) = &mut self.log {
            // A full disk shall not end the walk.
            let _ = writeln!(log, "{gap:.6} {}", u8::from(is_baking)).and_then(|()| log.flush());
        }
    }

    /// Time that the last frame took to draw, seconds.
    #[must_use]
    pub fn last_seconds(&self) -> f32 {
        self.last_seconds
    }

    /// Time that a frame takes to draw, smoothed, seconds.
    #[must_use]
    pub fn frame_seconds(&self) -> f32 {
        self.frame_seconds
    }

    /// Frames a second while something moves, smoothed; 0 before anything has.
    #[must_use]
    pub fn frame_rate(&self) -> f32 {
        if self.gap_seconds > 0.0 { 1.0 / self.gap_seconds } else { 0.0 }
    }
}

fn smooth(mean: &mut f32, newest: f32) {
    *mean = if *mean == 0.0 { newest } else { *mean + SMOOTHING * (newest - *mean) };
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pacer(log: Option<&Path>) -> Pacer {
        Pacer::new(60.0, log).expect("a pacer")
    }

    #[test]
    fn nothing_is_due_when_nothing_has_changed() {
        let mut pacer = pacer(None);
        pacer.begin();
        pacer.end(false);
        assert_eq!(pacer.due(false), None);
        pacer.want();
        assert!(pacer.due(false).is_some());
    }

    #[test]
    fn a_bake_gets_its_turn_between_frames() {
        let mut pacer = pacer(None);
        pacer.begin();
        std::thread::sleep(Duration::from_millis(40));
        pacer.end(true);
        pacer.want();
        let pause = pacer.due(true).expect("wanted") - pacer.ended;
        assert!(pause >= Duration::from_millis(10), "{pause:?}");
        assert!(pacer.due(false).expect("wanted") <= pacer.ended);
    }

    #[test]
    fn the_log_has_a_line_a_frame() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("frames.txt");
        let mut pacer = pacer(Some(&path));
        for is_baking in [false, true] {
            pacer.want();
            pacer.begin();
            pacer.end(is_baking);
        }
        let text = std::fs::read_to_string(&path).expect("a log");
        let flags: Vec<_> = text.lines().filter_map(|line| line.split_once(' ')).map(|(_, flag)| flag).collect();
        assert_eq!(flags, ["0", "1"], "{text}");
    }

    #[test]
    fn a_log_that_cannot_be_written_is_refused() {
        let message = Pacer::new(60.0, Some(Path::new("/no/such/folder/log"))).err().map(|error| error.to_string());
        assert!(message.is_some_and(|message| message.contains("/no/such/folder/log")));
    }
}
