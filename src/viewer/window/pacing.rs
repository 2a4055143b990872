//! Pacing of frames. A frame is drawn only after something has changed, and no faster than the screen refreshes. During
//! a bake each frame is followed by a pause in which the bake proceeds.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use std::time::{Duration, Instant};

use anyhow::Context;

/// Pause after a frame during a bake, as a fraction of the time that the frame took to draw. It is at least
/// [`SHORTEST_PAUSE`].
const PAUSE_SHARE: f32 = 0.25;
/// Shortest pause after a frame during a bake.
const SHORTEST_PAUSE: Duration = Duration::from_millis(8);
/// Weight of the last frame in smoothed times.
const SMOOTHING: f32 = 0.1;

/// Decides when the next frame is due, and measures frames.
pub struct Pacer {
    /// Time at which the next frame was requested; `None` if no frame is requested.
    requested: Option<Instant>,
    /// Shortest time between two frames.
    interval: Duration,
    began: Instant,
    ended: Instant,
    /// True if the frame was requested right after the last one, which is the case during a movement.
    is_continuous: bool,
    frame_seconds: f32,
    last_seconds: f32,
    gap_seconds: f32,
    log: Option<BufWriter<File>>,
}

impl Pacer {
    /// Creates a pacer for a screen with `refresh_rate`, hertz. It writes the times of frames into `log` if that is
    /// given.
    ///
    /// # Errors
    /// Returns an error if the log cannot be written.
    pub fn new(refresh_rate: f32, log: Option<&Path>) -> anyhow::Result<Self> {
        let open = |path: &Path| {
            let file = File::create(path).with_context(|| format!("cannot write {}", path.display()))?;
            anyhow::Ok(BufWriter::new(file))
        };
        let now = Instant::now();
        Ok(Self {
            requested: Some(now),
            // Presentation synchronises frames with the screen, so the interval is slightly shorter than the screen's.
            interval: Duration::from_secs_f32(0.8 / refresh_rate.max(1.0)),
            began: now,
            ended: now,
            is_continuous: false,
            frame_seconds: 0.0,
            last_seconds: 0.0,
            gap_seconds: 0.0,
            log: log.map(open).transpose()?,
        })
    }

    /// Requests a frame.
    pub fn request(&mut self) {
        self.requested.get_or_insert_with(Instant::now);
    }

    /// Returns when the requested frame is to be drawn; `None` if none is requested.
    #[must_use]
    pub fn due(&self, is_baking: bool) -> Option<Instant> {
        self.requested?;
        let steady = self.began + self.interval;
        if !is_baking {
            return Some(steady);
        }
        let pause = Duration::from_secs_f32(PAUSE_SHARE * self.frame_seconds).max(SHORTEST_PAUSE);
        Some(steady.max(self.ended + pause))
    }

    /// Begins a frame. Returns the time by which motion advances, seconds.
    pub fn begin(&mut self) -> f32 {
        let now = Instant::now();
        self.is_continuous = self.requested.is_some_and(|requested| requested <= self.ended + Duration::from_millis(1));
        let since = now - self.began;
        self.began = now;
        // The first frame of a movement follows no other frame.
        if self.is_continuous { since.as_secs_f32() } else { self.interval.as_secs_f32() }
    }

    /// Ends a frame that is on the screen. Logs `SECONDS BAKING`: the time since its request, and 1 during a bake or 0
    /// otherwise.
    pub fn end(&mut self, is_baking: bool) {
        let now = Instant::now();
        let requested = self.requested.take().unwrap_or(self.began);
        // During a movement a frame is requested when the last one is shown. `gap` is then the interval between two
        // frames.
        let gap = (now - requested).as_secs_f32();
        self.last_seconds = (now - self.began).as_secs_f32();
        smooth(&mut self.frame_seconds, self.last_seconds);
        if self.is_continuous {
            smooth(&mut self.gap_seconds, gap);
        }
        self.ended = now;
        if let Some(log) = &mut self.log {
            // A full disk must not end the program.
            let _ = writeln!(log, "{gap:.6} {}", u8::from(is_baking)).and_then(|()| log.flush());
        }
    }

    /// Returns the time that the last frame took to draw, seconds.
    #[must_use]
    pub fn last_seconds(&self) -> f32 {
        self.last_seconds
    }

    /// Returns the smoothed time that a frame takes to draw, seconds.
    #[must_use]
    pub fn frame_seconds(&self) -> f32 {
        self.frame_seconds
    }

    /// Returns the smoothed number of frames per second during movements; 0 before the first movement.
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
    fn no_frame_is_due_without_a_request() {
        let mut pacer = pacer(None);
        pacer.begin();
        pacer.end(false);
        assert_eq!(pacer.due(false), None);
        pacer.request();
        assert!(pacer.due(false).is_some());
    }

    #[test]
    fn a_bake_proceeds_between_frames() {
        let mut pacer = pacer(None);
        pacer.begin();
        std::thread::sleep(Duration::from_millis(40));
        pacer.end(true);
        pacer.request();
        let pause = pacer.due(true).expect("requested") - pacer.ended;
        assert!(pause >= Duration::from_millis(10), "{pause:?}");
        assert!(pacer.due(false).expect("requested") <= pacer.ended);
    }

    #[test]
    fn the_log_has_a_line_for_each_frame() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("frames.txt");
        let mut pacer = pacer(Some(&path));
        for is_baking in [false, true] {
            pacer.request();
            pacer.begin();
            pacer.end(is_baking);
        }
        let text = std::fs::read_to_string(&path).expect("a log");
        let flags: Vec<_> = text.lines().filter_map(|line| line.split_once(' ')).map(|(_, flag)| flag).collect();
        assert_eq!(flags, ["0", "1"], "{text}");
    }

    #[test]
    fn a_log_that_cannot_be_written_is_an_error() {
        let message = Pacer::new(60.0, Some(Path::new("/no/such/folder/log"))).err().map(|error| error.to_string());
        assert!(message.is_some_and(|message| message.contains("/no/such/folder/log")));
    }
}
