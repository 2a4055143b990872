//! Decides what the next frame shows: which picture, at which level of detail, and when tracing of the view begins.

use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::render::View;
use crate::render::shadow::known_fault;
use crate::viewer::drawing::canvas::Change;
use crate::viewer::job::{JobKind, JobResult};
use crate::viewer::picture::content::{Detail, NextPicture, PictureContent};
use crate::viewer::picture::marks_cache::MarkSelection;
use crate::viewer::settings::view::Tab;
use crate::viewer::solution::traced_view::{self, TracedViewRequest, with_fixed_exposure};
use crate::viewer::window::shadow_notes;
use crate::viewer::window::viewer::Viewer;

/// Time without a change after which a sketch is replaced by a finer picture.
const SKETCH_TIME: Duration = Duration::from_millis(250);
/// Time without a change after which tracing of the view begins.
const STILL_TIME: Duration = Duration::from_millis(600);

impl Viewer {
    /// Returns the picture to draw; `None` if the last one is still valid.
    pub fn next_picture(&mut self) -> Option<NextPicture> {
        let content = self.picture_content()?;
        let change = self.surface.canvas.change(&content);
        let Some(detail) = self.next_detail(change) else {
            let more = self.more_light(&content);
            if more.is_none() {
                self.trace_at_rest(&content);
            }
            return more;
        };
        self.jobs.end(JobKind::TraceView);
        self.picture.notes.num_rays = None;
        self.picture.refinement.tracing_begins =
            self.panels.preferences.traces_stills.then(|| Instant::now() + STILL_TIME);
        self.note_shadows(&content);
        let batch = (detail == Detail::Fine && self.adds_up(&content)).then(|| self.begin_batches());
        Some(NextPicture { content, detail, batch, is_partial: false })
    }

    /// Returns the level of detail of the picture after `change`; `None` if no new picture is needed.
    fn next_detail(&mut self, change: Change) -> Option<Detail> {
        let canvas = &self.surface.canvas;
        let at_rest =
            if canvas.is_software() && self.session.worker().is_some() { Detail::Plain } else { Detail::Fine };
        let sketch_ends = &mut self.picture.refinement.sketch_ends;
        match change {
            Change::Content if canvas.is_software() => {
                *sketch_ends = Some(Instant::now() + SKETCH_TIME);
                Some(Detail::Sketch)
            }
            Change::Content => Some(Detail::Fine),
            // New light does not change the level of detail.
            Change::Light if sketch_ends.is_some() => Some(Detail::Sketch),
            Change::Light => Some(at_rest),
            Change::None => {
                let has_rested = sketch_ends.is_none_or(|end| end <= Instant::now());
                if !has_rested || canvas.detail() >= Some(at_rest) {
                    return None;
                }
                *sketch_ends = None;
                Some(at_rest)
            }
        }
    }

    fn picture_content(&mut self) -> Option<PictureContent> {
        let gpu = Arc::clone(&self.surface.gpu);
        let (panels, results) = (&self.panels, &self.results);
        let open_scene = self.session.open_scene.as_mut()?;
        open_scene.show_moment(&gpu, panels.replay, results.recording.as_deref());
        let scene = open_scene.visible_buffers(&gpu, &panels.selection.hidden);
        let replayed = results.recording.as_ref().filter(|_| panels.replay.is_on);
        let moment = replayed.and_then(|recording| recording.moments.get(panels.replay.moment));
        let shown_advice = panels.shown_advice.map(|shown| shown.advice);
        let marks = MarkSelection {
            scene: &open_scene.uploaded.scene,
            solved: open_scene.solved.as_ref(),
            wire: panels.preferences.wire,
            instances: panels.chosen_instances(),
            advice: shown_advice.and_then(|index| Some((index, open_scene.advice.get(index)?.locations.as_slice()))),
            patch_view: results
                .patch_view
                .as_ref()
                .filter(|_| panels.shows_heat && panels.preferences.tab == Tab::Meter),
            shooter: moment.and_then(|moment| moment.shooter),
        };
        Some(PictureContent {
            scene,
            overlay: self.picture.marks.overlay(&gpu, &marks),
            shadows: Arc::clone(&open_scene.uploaded.shadows),
            light: open_scene.light_version,
            view: View::from_camera(&open_scene.controller.pose.camera(), self.picture.aspect()),
            settings: panels.light.render_settings(open_scene.is_lit),
            compared_shadows: panels.light.compared_shadows(),
            size: self.picture.size,
        })
    }

    /// Stores the known fault and the number of light samples of a new picture.
    fn note_shadows(&mut self, content: &PictureContent) {
        let scene = content.shadows.scene();
        let shadows = content.settings.shadows.as_ref();
        let fault = shadows.and_then(|settings| known_fault(&content.shadows, &content.view, settings));
        let notes = &mut self.picture.notes;
        notes.fault = fault.map(|fault| shadow_notes::message_about(fault, scene));
        notes.num_light_samples = shadows.map_or(0, |settings| settings.samples(&content.shadows).len());
    }

    /// Begins to trace the view after [`STILL_TIME`] without a change, if tracing at rest is switched on.
    fn trace_at_rest(&mut self, content: &PictureContent) {
        let is_on = self.panels.preferences.traces_stills;
        let refinement = &mut self.picture.refinement;
        let was_on = std::mem::replace(&mut refinement.was_tracing_on, is_on);
        if !is_on {
            return self.end_tracing();
        }
        if !was_on {
            refinement.tracing_begins = Some(Instant::now());
        }
        let is_due = refinement.tracing_begins.is_some_and(|begin| begin <= Instant::now());
        if is_due && self.surface.canvas.detail() >= Some(Detail::Fine) {
            refinement.tracing_begins = None;
            self.begin_tracing(content);
        }
    }

    /// Ends tracing, and replaces a traced picture by a drawn one in the next frame.
    fn end_tracing(&mut self) {
        self.picture.refinement.tracing_begins = None;
        self.jobs.end(JobKind::TraceView);
        self.picture.notes.num_rays = None;
        if self.surface.canvas.detail() == Some(Detail::Traced) {
            self.surface.canvas.forget();
            self.pacer.request();
        }
    }

    /// Starts to trace the view if rays show the same as rasterisation.
    fn begin_tracing(&mut self, content: &PictureContent) {
        let Some(open_scene) = &self.session.open_scene else { return };
        let Some(solved) = open_scene.solved.clone() else { return };
        let panels = &self.panels;
        let is_plain = content.overlay.is_none() && panels.selection.hidden.is_empty() && !panels.replay.is_on;
        let pose = &open_scene.controller.pose;
        let aspect = content.size[0] as f32 / content.size[1] as f32;
        let matches =
            |collider| traced_view::matches_rasterisation(&content.settings, pose, aspect, collider, &open_scene.scene);
        if !is_plain || !matches(&open_scene.collider) {
            return;
        }
        let request = TracedViewRequest {
            camera: pose.camera(),
            size: content.size,
            settings: with_fixed_exposure(&content.settings, self.metered_ev()),
            dials: panels.light.groups.clone(),
        };
        let started = self.jobs.start(JobKind::TraceView, move |job| {
            traced_view::trace(&solved, &request, job, |traced| job.send(JobResult::TracedView(Box::new(traced))));
        });
        self.report(started);
    }
}
