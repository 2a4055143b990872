//! What keys and panels ask for, and how it is done.

use std::path::PathBuf;

use winit::window::Fullscreen;

use super::camera::Eye;
use super::panels::{Action, AdviceLocation, Notice, OpenDialog, Trouble};
use super::place::Place;
use super::walkthrough::Walkthrough;
use super::worker::Source;
use crate::bake::BakeSettings;
use crate::base::bounds::Bounds;
use crate::base::ids::TriangleId;
use crate::scene::Scene;

/// One notch of the wheel changes the field of view by this factor.
const ZOOM_NOTCH: f32 = 1.08;
/// Narrowest and widest field of view, degrees.
const FOV_RANGE: [f32; 2] = [10.0, 120.0];

impl Walkthrough {
    /// Opens a file that was dropped on the window.
    pub(super) fn open(&mut self, path: PathBuf) {
        self.panels.notice = Some(Notice::new(format!("Opening {}", path.display())));
        let settings = self.next_settings();
        let outcome = self.session.open(Source::of(path), None, settings);
        self.report(outcome);
    }

    /// Reads the open file again.
    pub(super) fn reload(&mut self, why: &str) {
        self.panels.notice = Some(Notice::new(why));
        let outcome = self.session.reload(self.next_settings());
        self.report(outcome);
    }

    /// What the command line says, unless another preset has been picked since.
    pub(super) fn next_settings(&self) -> BakeSettings {
        let is_as_given = self.panels.quality == self.settings.quality;
        if is_as_given { self.settings } else { BakeSettings::preset(self.panels.quality) }
    }

    pub(super) fn report(&mut self, outcome: anyhow::Result<()>) {
        if let Err(error) = outcome {
            self.panels.trouble = Some(Trouble { title: "This did not work".to_owned(), text: format!("{error:#}") });
        }
    }

    /// Does what a key or a panel asks for.
    pub(super) fn perform(&mut self, action: Action) {
        let light = &mut self.panels.light;
        match action {
            Action::ToggleAutoExposure if light.is_auto => self.hold_exposure(),
            Action::ToggleAutoExposure => light.is_auto = true,
            Action::StepExposure(steps) => {
                self.hold_exposure();
                self.panels.light.step_exposure(steps);
            }
            Action::NextToneMap => light.next_tone_map(),
            Action::NextShading => light.next_shading(),
            Action::ToggleDirect => light.direct = !light.direct,
            Action::ToggleIndirect => light.indirect = !light.indirect,
            Action::ToggleHelp => self.panels.shows_help = !self.panels.shows_help,
            Action::TogglePanels => self.panels.memory.is_open = !self.panels.memory.is_open,
            Action::ToggleStills => self.toggle_stills(),
            Action::ToggleFullScreen => self.toggle_full_screen(),
            Action::Screenshot => self.take_picture(),
            Action::ToggleBake if self.session.worker().is_some() => self.cancel(),
            Action::Bake | Action::ToggleBake => {
                self.forget();
                let outcome = self.session.bake(self.next_settings());
                self.report(outcome);
            }
            Action::CancelBake => self.cancel(),
            Action::OpenBuiltIn => {
                let outcome = self.session.open(Source::default(), None, self.next_settings());
                self.report(outcome);
            }
            Action::Open(path) => self.open(path),
            Action::ChooseFile => self.choose_file(),
            Action::Reload => self.reload("Reading the file again"),
            Action::SetVariant(variant) => {
                let outcome = self.session.wear(variant, self.next_settings());
                self.report(outcome);
            }
            Action::FitLuxScale => self.fit_lux_scale(),
            Action::Jump(_)
            | Action::StepCamera(_)
            | Action::FrameAll
            | Action::ShowWhere(_)
            | Action::FrameInstance(_)
            | Action::SetFieldOfView(_)
            | Action::ToggleWalking => self.travel(action),
            Action::Recall(number) => self.recall(number),
            Action::Bookmark(number) => self.bookmark(number),
            Action::Take(_)
            | Action::Pin
            | Action::ClearReadings
            | Action::WriteReadings
            | Action::ClosePatchView
            | Action::ToggleRecording
            | Action::SaveBake
            | Action::WritePicture
            | Action::CancelPicture => self.inquire(action),
        }
        self.pacer.want();
    }

    fn travel(&mut self, action: Action) {
        let [width, height] = self.picture_size;
        let Some(Place { scene, collider, traveller, camera, advice, .. }) = &mut self.session.place else { return };
        match action {
            Action::ShowWhere(number) => {
                let Some(advice) = advice.get(number) else { return };
                let last = self.panels.shown_advice.filter(|shown| shown.advice == number);
                let place = last.map_or(0, |shown| (shown.location + 1) % advice.places.len().max(1));
                self.panels.shown_advice = Some(AdviceLocation { advice: number, location: place });
                if let Some(bounds) = advice.bounds(place) {
                    traveller.frame(bounds, width as f32 / height as f32);
                }
            }
            Action::FrameAll => traveller.frame_all(collider, width as f32 / height as f32),
            Action::FrameInstance(index) => {
                if let Some(bounds) = bounds_of(scene, index) {
                    traveller.frame(bounds, width as f32 / height as f32);
                }
            }
            Action::SetFieldOfView(degrees) => traveller.eye.fov_y = degrees.to_radians(),
            Action::ToggleWalking if traveller.toggle_walking(collider).is_err() => {
                self.panels.notice = Some(Notice::new("No floor below to walk on: still flying"));
            }
            Action::Jump(index) => *camera = index,
            Action::StepCamera(steps) => *camera = wrapped(*camera, steps, scene.cameras.len()),
            _ => {}
        }
        if matches!(action, Action::Jump(_) | Action::StepCamera(_))
            && let Some(camera) = scene.cameras.get(*camera)
        {
            traveller.jump(Eye::from_camera(camera), collider);
            self.panels.notice = Some(Notice::new(format!("Camera: {}", camera.name)));
        }
    }

    fn hold_exposure(&mut self) {
        let metered_ev = self.screen.canvas.metered_ev(&self.screen.gpu);
        self.panels.light.hold_exposure(metered_ev);
    }

    fn cancel(&mut self) {
        if let Some(worker) = self.session.worker() {
            log::info!("the bake shall end");
            worker.cancel();
        }
    }

    fn toggle_full_screen(&self) {
        let is_full = self.window.fullscreen().is_some();
        self.window.set_fullscreen((!is_full).then_some(Fullscreen::Borderless(None)));
    }

    fn toggle_stills(&mut self) {
        let traces = &mut self.panels.memory.traces_stills;
        *traces = !*traces;
        let text = if *traces { "A still camera traces rays" } else { "No rays for a still camera" };
        self.panels.notice = Some(Notice::new(text));
    }

    fn choose_file(&mut self) {
        let last = self.panels.memory.recent.first().and_then(|path| path.parent().map(PathBuf::from));
        let folder = last.filter(|folder| folder.is_dir()).unwrap_or_else(|| PathBuf::from("."));
        self.look.release(&self.window);
        self.panels.dialog = Some(OpenDialog::new(&folder));
    }

    fn fit_lux_scale(&mut self) {
        if let Some(place) = &self.session.place {
            self.panels.light.lux_scale = place.fitted_scale(self.panels.light.lux_scale);
        }
    }

    fn recall(&mut self, number: u8) {
        let name = self.session.name();
        let Some(Place { collider, traveller, .. }) = &mut self.session.place else { return };
        let text = match self.panels.memory.marked(&name, number) {
            Some(eye) => {
                traveller.jump(eye, collider);
                format!("Bookmark {number}")
            }
            None => format!("No bookmark {number} yet: Ctrl {number} sets it"),
        };
        self.panels.notice = Some(Notice::new(text));
    }

    fn bookmark(&mut self, number: u8) {
        let name = self.session.name();
        let Some(place) = &self.session.place else { return };
        self.panels.memory.mark(&name, number, &place.traveller.eye);
        self.panels.notice = Some(Notice::new(format!("This view is bookmark {number}")));
    }

    /// Narrows the view by notches of the wheel.
    pub(super) fn zoom(&mut self, notches: f32) {
        if let Some(place) = &mut self.session.place {
            let angle = &mut place.traveller.eye.fov_y;
            *angle = (*angle * ZOOM_NOTCH.powf(-notches)).clamp(FOV_RANGE[0].to_radians(), FOV_RANGE[1].to_radians());
        }
    }
}

/// Box round an instance.
fn bounds_of(scene: &Scene, index: usize) -> Option<Bounds> {
    let triangles = scene.instances.get(index)?.triangles.clone();
    Bounds::around(triangles.flat_map(|t| scene.corners(TriangleId::new(t))))
}

/// `index` moved on by `steps` in a ring of `count`.
fn wrapped(index: usize, steps: isize, count: usize) -> usize {
    if count == 0 { 0 } else { (index as isize + steps).rem_euclid(count as isize) as usize }
}

#[cfg(test)]
mod tests {
    use super::wrapped;

    #[test]
    fn cameras_are_a_ring() {
        assert_eq!(wrapped(0, -1, 3), 2);
        assert_eq!(wrapped(2, 1, 3), 0);
        assert_eq!(wrapped(0, 1, 0), 0);
    }
}
