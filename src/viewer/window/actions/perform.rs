//! Performs an action.

use winit::window::Fullscreen;

use crate::render::shadow::DebugView;
use crate::viewer::action::Action;
use crate::viewer::job::JobKind;
use crate::viewer::session::source::Source;
use crate::viewer::settings::tool::Tool;
use crate::viewer::settings::view::Tab;
use crate::viewer::window::viewer::Viewer;

impl Viewer {
    /// Performs an action that a key or a panel requests.
    pub fn perform(&mut self, action: Action) {
        match action {
            Action::Bake | Action::CancelBake | Action::ToggleBake | Action::SaveBake | Action::ToggleRecording => {
                self.perform_on_bake(action);
            }
            Action::OpenBuiltIn => self.open_source(Source::default()),
            Action::Open(path) => self.open_file(path),
            Action::ChooseFile => self.choose_file(),
            Action::Reload => {
                self.reload("Reading the file again");
                self.reload_shaders();
            }
            Action::SetVariant(variant) => {
                let outcome = self.session.choose_variant(variant, self.next_settings());
                self.report(outcome);
            }
            Action::GoToCamera(_)
            | Action::StepCamera(_)
            | Action::FrameAll
            | Action::ShowAdvice(_)
            | Action::FrameInstance(_)
            | Action::SetFieldOfView(_)
            | Action::ToggleWalking => self.move_camera(action),
            Action::GoToBookmark(number) => self.go_to_bookmark(number),
            Action::SetBookmark(number) => self.set_bookmark(number),
            Action::Screenshot => self.take_screenshot(),
            Action::WritePicture => self.write_picture(),
            Action::CancelPicture => self.jobs.end(JobKind::Write),
            Action::SelectTool(tool) => self.select_tool(tool),
            Action::PinReading => self.results.measurements.pin(),
            Action::ClearReadings => self.results.measurements = Default::default(),
            Action::WriteReadings => self.write_readings(),
            Action::ClosePatchView => self.results.patch_view = None,
            Action::FitLuxScale
            | Action::StepExposure(_)
            | Action::ToggleAutoExposure
            | Action::NextToneMap
            | Action::NextShading
            | Action::ToggleDirect
            | Action::ToggleIndirect => self.change_light(action),
            Action::ToggleStills => self.toggle_tracing(),
            Action::ToggleHelp => self.panels.shows_help = !self.panels.shows_help,
            Action::TogglePanels => self.panels.preferences.is_open = !self.panels.preferences.is_open,
            Action::ToggleFullScreen => self.toggle_full_screen(),
        }
        self.pacer.request();
    }

    fn perform_on_bake(&mut self, action: Action) {
        match action {
            Action::SaveBake => self.save_bake(),
            Action::ToggleRecording => self.toggle_recording(),
            Action::CancelBake => self.cancel_bake(),
            Action::ToggleBake if self.session.worker().is_some() => self.cancel_bake(),
            _ => {
                self.discard_results();
                let outcome = self.session.bake(self.next_settings());
                self.report(outcome);
            }
        }
    }

    fn cancel_bake(&mut self) {
        if let Some(worker) = self.session.worker() {
            log::info!("the user has cancelled the bake");
            worker.cancel();
        }
    }

    fn change_light(&mut self, action: Action) {
        let light = &mut self.panels.light;
        match action {
            Action::ToggleAutoExposure if light.is_auto => self.fix_exposure(),
            Action::ToggleAutoExposure => light.is_auto = true,
            Action::StepExposure(steps) => {
                self.fix_exposure();
                self.panels.light.step_exposure(steps);
            }
            Action::NextToneMap => light.next_tone_map(),
            Action::NextShading => light.next_shading(),
            Action::ToggleDirect => light.direct = !light.direct,
            Action::ToggleIndirect => light.indirect = !light.indirect,
            Action::FitLuxScale => {
                if let Some(open_scene) = &self.session.open_scene {
                    light.lux_scale = open_scene.fitted_scale(light.lux_scale);
                }
            }
            _ => {}
        }
    }

    fn fix_exposure(&mut self) {
        let metered_ev = self.metered_ev();
        self.panels.light.fix_exposure(metered_ev);
    }

    fn toggle_tracing(&mut self) {
        let traces = &mut self.panels.preferences.traces_stills;
        *traces = !*traces;
        let text = if *traces {
            "Rays are traced while the camera rests"
        } else {
            "No rays are traced while the camera rests"
        };
        self.notify(text);
    }

    fn toggle_full_screen(&self) {
        let is_full = self.window.fullscreen().is_some();
        self.window.set_fullscreen((!is_full).then_some(Fullscreen::Borderless(None)));
    }

    /// Selects a tool and shows the section of the panels that belongs to it.
    fn select_tool(&mut self, tool: Tool) {
        self.controls.mouse.set_free(&self.window);
        self.panels.tool = tool;
        let (tab, section) = match tool {
            Tool::Meter | Tool::Grid => (Tab::Meter, "Lux meter"),
            Tool::PatchView => (Tab::Meter, "View from here"),
            Tool::Choose => (Tab::Place, "Scene"),
            Tool::Receiver => {
                // The debug view shows which planes are chosen.
                self.panels.light.debug = Some(DebugView::Receivers);
                return;
            }
            Tool::Caster | Tool::Look => return,
        };
        self.panels.preferences.tab = tab;
        self.panels.preferences.sections.insert(section.to_owned(), true);
    }
}
