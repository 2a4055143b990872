//! The next picture: what it shows, how finely it is drawn, and when a still camera begins to trace.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::canvas::Change;
use super::errand::Kind;
use super::marks_cache::Wanted;
use super::panels::Tab;
use super::screen::NewPicture;
use super::shadow_notes;
use super::sight::{Detail, Sight};
use super::still::{self, Subject};
use super::walkthrough::Walkthrough;
use crate::render::View;
use crate::render::shadow::known_fault;

/// A sketch is drawn out when nothing has moved for this long.
const SETTLE_TIME: Duration = Duration::from_millis(250);
/// A still camera traces when nothing has changed for this long.
const STILL_TIME: Duration = Duration::from_millis(600);

impl Walkthrough {
    /// What has to be drawn anew, and how finely; none where the last picture is still right.
    pub(super) fn next_picture(&mut self) -> Option<NewPicture> {
        let sight = self.sight()?;
        let canvas = &self.screen.canvas;
        let at_rest = if canvas.is_slow() && self.session.worker().is_some() { Detail::Plain } else { Detail::Fine };
        let detail = match canvas.change(&sight) {
            Change::Sight if canvas.is_slow() => {
                self.settle = Some(Instant::now() + SETTLE_TIME);
                Detail::Sketch
            }
            Change::Sight => Detail::Fine,
            // Light alone does not make a picture coarse.
            Change::Light if self.settle.is_some() => Detail::Sketch,
            Change::Light => at_rest,
            Change::None => {
                let is_settled = self.settle.is_none_or(|settle| settle <= Instant::now());
                if !is_settled || canvas.detail() >= Some(at_rest) {
                    if let Some(more) = self.more_light(&sight) {
                        return Some(more);
                    }
                    self.keep_still(&sight);
                    return None;
                }
                self.settle = None;
                at_rest
            }
        };
        self.errands.end(Kind::Still);
        self.inquiry.num_rays = None;
        self.still_due = self.panels.memory.traces_stills.then(|| Instant::now() + STILL_TIME);
        self.note_shadows(&sight);
        let batch = (detail == Detail::Fine && self.adds_up(&sight)).then(|| self.begin_batches());
        Some(NewPicture { sight, detail, batch, is_partial: false })
    }

    fn sight(&mut self) -> Option<Sight> {
        let size = self.picture_size;
        let gpu = Arc::clone(&self.screen.gpu);
        let (panels, inquiry) = (&self.panels, &self.inquiry);
        let place = self.session.place.as_mut()?;
        place.show_moment(&gpu, panels.replay, inquiry.recording.as_deref());
        let replayed = inquiry.recording.as_ref().filter(|_| panels.replay.is_on);
        let moment = replayed.and_then(|recording| recording.moments.get(panels.replay.moment));
        let wanted = Wanted {
            wire: panels.memory.wire,
            chosen: panels.chosen_instances(),
            found: panels.shown_advice.map(|shown| shown.advice),
            sight: inquiry.sight.as_ref().filter(|_| panels.shows_heat && panels.memory.tab == Tab::Meter),
            shooter: moment.and_then(|moment| moment.shooter),
        };
        Some(Sight {
            scene: place.shown(&gpu, &panels.selection.hidden),
            overlay: self.marks.overlay(&gpu, place, &wanted),
            shadows: Arc::clone(&place.mesh.shadows),
            light: place.light_version,
            view: View::from_camera(&place.traveller.eye.camera(), size[0] as f32 / size[1] as f32),
            settings: panels.light.render_settings(place.is_lit),
            rival: panels.light.rival(),
            size,
        })
    }

    /// What is worth knowing of the shadows of a new picture.
    fn note_shadows(&mut self, sight: &Sight) {
        let scene = sight.shadows.scene();
        let shadows = sight.settings.shadows.as_ref();
        let fault = shadows.and_then(|settings| known_fault(&sight.shadows, &sight.view, settings));
        self.inquiry.fault = fault.map(|fault| shadow_notes::in_words(fault, scene));
        self.inquiry.num_light_samples = shadows.map_or(0, |settings| settings.samples(&sight.shadows).len());
    }

    /// Nothing has changed: begins to trace when that has lasted long enough, and where rays show the same light.
    fn keep_still(&mut self, sight: &Sight) {
        let is_new = self.panels.memory.traces_stills && !self.traced_stills;
        self.traced_stills = self.panels.memory.traces_stills;
        if is_new {
            self.still_due = Some(Instant::now());
        }
        if !self.panels.memory.traces_stills {
            self.still_due = None;
            self.errands.end(Kind::Still);
            self.inquiry.num_rays = None;
            if self.screen.canvas.detail() == Some(Detail::Traced) {
                // The next frame draws the picture anew.
                self.screen.canvas.forget();
                self.pacer.want();
            }
            return;
        }
        if self.still_due.is_none_or(|due| due > Instant::now()) || self.screen.canvas.detail() < Some(Detail::Fine) {
            return;
        }
        self.still_due = None;
        let Some(place) = &self.session.place else { return };
        let Some(solved) = place.solved.clone() else { return };
        let aspect = sight.size[0] as f32 / sight.size[1] as f32;
        let is_plain = sight.overlay.is_none() && self.panels.selection.hidden.is_empty() && !self.panels.replay.is_on;
        let eye = &place.traveller.eye;
        if !is_plain || !still::suits(&sight.settings, eye, aspect, &place.collider, &place.scene) {
            return;
        }
        let metered_ev = self.screen.canvas.metered_ev(&self.screen.gpu);
        let subject = Subject {
            camera: eye.camera(),
            size: sight.size,
            settings: still::held(&sight.settings, metered_ev),
            dials: self.panels.light.groups.clone(),
        };
        let sent =
            self.errands.send(Kind::Still, self.session.job(), move |bearer| still::trace(bearer, &solved, &subject));
        self.report(sent);
    }
}
