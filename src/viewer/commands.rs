//! What keys and panels ask for, and how it is done.

use std::path::{Path, PathBuf};

use winit::window::Fullscreen;

use super::bake_worker::Source;
use super::camera::Eye;
use super::panels::{Command, Notice, Trouble};
use super::screenshot;
use super::session::Place;
use super::walkthrough::Walkthrough;
use crate::bake::BakeSettings;

impl Walkthrough {
    /// Opens a file that was dropped on the window.
    pub(super) fn open(&mut self, path: PathBuf) {
        self.panels.notice = Some(Notice::new(format!("Opening {}", path.display())));
        let settings = self.next_settings();
        let outcome = self.session.open(Source::of(path), settings);
        self.report(outcome);
    }

    /// What the command line says, unless another preset has been picked since.
    fn next_settings(&self) -> BakeSettings {
        let is_as_given = self.panels.quality == self.settings.quality;
        if is_as_given { self.settings } else { BakeSettings::preset(self.panels.quality) }
    }

    fn report(&mut self, outcome: anyhow::Result<()>) {
        if let Err(error) = outcome {
            self.panels.trouble = Some(Trouble { title: "This did not work".to_owned(), text: format!("{error:#}") });
        }
    }

    /// Does what a key or a panel asks for.
    pub(super) fn perform(&mut self, command: Command) {
        let light = &mut self.panels.light;
        match command {
            Command::ToggleAutoExposure if light.is_auto => self.hold_exposure(),
            Command::ToggleAutoExposure => light.is_auto = true,
            Command::StepExposure(steps) => {
                self.hold_exposure();
                self.panels.light.step_exposure(steps);
            }
            Command::NextToneMap => light.next_tone_map(),
            Command::NextShading => light.next_shading(),
            Command::ToggleDirect => light.direct = !light.direct,
            Command::ToggleIndirect => light.indirect = !light.indirect,
            Command::ToggleHelp => self.panels.shows_help = !self.panels.shows_help,
            Command::TogglePanels => self.panels.is_open = !self.panels.is_open,
            Command::ToggleFullScreen => self.toggle_full_screen(),
            Command::Screenshot => self.take_picture(),
            Command::ToggleBake if self.session.worker().is_some() => self.cancel(),
            Command::Bake | Command::ToggleBake => {
                let outcome = self.session.bake(self.next_settings());
                self.report(outcome);
            }
            Command::CancelBake => self.cancel(),
            Command::OpenBuiltIn => {
                let outcome = self.session.open(Source::default(), self.next_settings());
                self.report(outcome);
            }
            Command::Jump(_) | Command::StepCamera(_) | Command::FrameAll | Command::ToggleWalking => {
                self.travel(command);
            }
        }
        self.pacer.want();
    }

    fn travel(&mut self, command: Command) {
        let [width, height] = self.picture_size;
        let Some(Place { scene, collider, traveller, camera, .. }) = &mut self.session.place else { return };
        match command {
            Command::FrameAll => traveller.frame_all(collider, width as f32 / height as f32),
            Command::ToggleWalking if traveller.toggle_walking(collider).is_err() => {
                self.panels.notice = Some(Notice::new("No floor below to walk on: still flying"));
            }
            Command::Jump(index) => *camera = index,
            Command::StepCamera(steps) => *camera = wrapped(*camera, steps, scene.cameras.len()),
            _ => {}
        }
        if matches!(command, Command::Jump(_) | Command::StepCamera(_))
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

    fn take_picture(&mut self) {
        let size = self.screen.size();
        let Some(place) = &self.session.place else { return };
        let camera = place.traveller.eye.camera();
        let look = self.panels.light.look(place.is_lit);
        match screenshot::take(&self.screen.gpu, place, &camera, size, &look, Path::new(".")) {
            Ok(path) => self.panels.notice = Some(Notice::new(format!("Written: {}", path.display()))),
            Err(error) => self.report(Err(error)),
        }
    }
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
