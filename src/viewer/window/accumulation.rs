//! Accumulation of soft shadows while the camera rests.
//!
//! The mean of the hard shadows from points of a lamp converges to its soft shadow (Haeberli and Akeley 1990). Each
//! frame adds as many light samples as it has time for, so that the window stays responsive.

use crate::render::ShadowSettings;
use crate::render::shadow::{MOST_POINTS, SampleBatch, num_batches};
use crate::viewer::picture::content::{Detail, NextPicture, PictureContent};
use crate::viewer::settings::comparison::ComparisonLayout;
use crate::viewer::window::viewer::Viewer;

/// Time of a frame above which the next one adds fewer samples, seconds.
const SLOW_FRAME: f32 = 0.1;

impl Viewer {
    /// Returns true if the shadows improve when light samples are added up.
    pub fn adds_up(&self, content: &PictureContent) -> bool {
        let is_soft = |settings: &ShadowSettings| {
            let scene = content.shadows.scene();
            let has_size = settings.light_radius > 0.0 || scene.materials.iter().any(|material| material.is_emissive());
            has_size && num_batches(settings.light_samples) > 1
        };
        let compared = content.compared_shadows.as_ref();
        let is_difference = compared.is_some_and(|compared| compared.layout == ComparisonLayout::Difference);
        content.settings.shadows.as_ref().is_some_and(is_soft)
            && !is_difference
            && !self.panels.preferences.traces_stills
            && self.session.worker().is_none()
    }

    /// Returns the batch of light samples of the first picture at rest.
    pub fn begin_batches(&mut self) -> SampleBatch {
        self.pacer.request();
        self.picture.refinement.samples_per_frame = 1;
        SampleBatch::whole(0)
    }

    /// Returns the picture with the next light samples; `None` if all have been added.
    pub fn more_light(&mut self, content: &PictureContent) -> Option<NextPicture> {
        let settings = content.settings.shadows.as_ref()?;
        let last = self.surface.canvas.batch().filter(|_| self.adds_up(content))?;
        let in_batch = |number| ShadowSettings { batch: Some(SampleBatch::whole(number)), ..settings.clone() };
        let length = |number| in_batch(number).samples(&content.shadows).len();
        let is_complete = last.first.saturating_add(last.count) >= length(last.number);
        let (number, first) = if is_complete { (last.number + 1, 0) } else { (last.number, last.first + last.count) };
        if number >= num_batches(settings.light_samples) {
            return None;
        }
        // The number of samples that fit into a frame is estimated from the time of the last one.
        let samples_per_frame = &mut self.picture.refinement.samples_per_frame;
        if self.pacer.last_seconds() > SLOW_FRAME {
            *samples_per_frame = (*samples_per_frame / 2).max(1);
        } else {
            *samples_per_frame *= 2;
        }
        let count = (*samples_per_frame).min(length(number).saturating_sub(first).max(1));
        self.pacer.request();
        let is_partial = first + count < length(number);
        let batch = Some(SampleBatch { number, first, count });
        Some(NextPicture { content: content.clone(), detail: Detail::Fine, batch, is_partial })
    }

    /// Returns the samples per lamp that have been added up, and their final number.
    pub fn num_points(&self) -> Option<[u32; 2]> {
        let count = num_batches(self.panels.light.shadows.light_samples);
        let done = self.surface.canvas.batch()?.number + 1;
        Some([done, count].map(|batches| batches * (MOST_POINTS / count)))
    }
}
