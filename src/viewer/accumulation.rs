//! Soft shadows become exact while the camera rests: light samples are added up, a few each frame, so that the window
//! answers in between.

use super::screen::NewPicture;
use super::sight::{Comparison, Detail, Sight};
use super::walkthrough::Walkthrough;
use crate::render::ShadowSettings;
use crate::render::shadow::{Batch, MOST_POINTS, num_batches};

/// Adding light may keep a frame for this long, seconds.
const FRAME_SHARE: f32 = 0.1;

impl Walkthrough {
    /// More and more points a lamp are worth adding up.
    pub(super) fn adds_up(&self, sight: &Sight) -> bool {
        let is_soft = |settings: &ShadowSettings| {
            let scene = sight.shadows.scene();
            let has_size = settings.light_radius > 0.0 || scene.materials.iter().any(|material| material.is_emissive());
            has_size && num_batches(settings.light_samples) > 1
        };
        let is_difference = sight.rival.as_ref().is_some_and(|rival| rival.comparison == Comparison::Difference);
        sight.settings.shadows.as_ref().is_some_and(is_soft)
            && !is_difference
            && !self.panels.memory.traces_stills
            && self.session.worker().is_none()
    }

    /// The first picture of a camera at rest.
    pub(super) fn begin_batches(&mut self) -> Batch {
        self.pacer.want();
        self.samples_a_frame = 1;
        Batch::whole(0)
    }

    /// The next light samples, where more are to come.
    pub(super) fn more_light(&mut self, sight: &Sight) -> Option<NewPicture> {
        let settings = sight.settings.shadows.as_ref()?;
        let last = self.screen.canvas.batch().filter(|_| self.adds_up(sight))?;
        let in_batch = |number| ShadowSettings { batch: Some(Batch::whole(number)), ..settings.clone() };
        let length = |number| in_batch(number).samples(&sight.shadows).len();
        let is_whole = last.first.saturating_add(last.count) >= length(last.number);
        let (number, first) = if is_whole { (last.number + 1, 0) } else { (last.number, last.first + last.count) };
        if number >= num_batches(settings.light_samples) {
            return None;
        }
        // As many as a frame has time for, going by the last.
        if self.pacer.last_seconds() > FRAME_SHARE {
            self.samples_a_frame = (self.samples_a_frame / 2).max(1);
        } else {
            self.samples_a_frame *= 2;
        }
        let count = self.samples_a_frame.min(length(number).saturating_sub(first).max(1));
        self.pacer.want();
        let is_partial = first + count < length(number);
        let batch = Some(Batch { number, first, count });
        Some(NewPicture { sight: sight.clone(), detail: Detail::Fine, batch, is_partial })
    }

    /// Points a lamp so far, and how many there will be.
    pub(super) fn num_points(&self) -> Option<[u32; 2]> {
        let count = num_batches(self.panels.light.shadows.light_samples);
        let done = self.screen.canvas.batch()?.number + 1;
        Some([done, count].map(|batches| batches * (MOST_POINTS / count)))
    }
}
