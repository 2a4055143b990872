//! What clicks in the picture have asked, and what errands have brought.

use std::path::Path;
use std::sync::Arc;

use super::collider::Pick;
use super::errand::{Finding, Kind};
use super::meter::{self, Grid, GridPlan, Reading};
use super::output::{self, Written, next_name};
use super::panels::{Action, Notice, Tab, Tool, Trouble};
use super::patch_sight::PatchSight;
use super::replay::Recording;
use super::still;
use super::walkthrough::Walkthrough;
use crate::baked;
use crate::render::shadow::DebugView;
use crate::scene::Camera;

/// What is known of the open scene beyond its picture.
#[derive(Default)]
pub struct Inquiry {
    /// The last reading.
    pub last: Option<Reading>,
    /// Readings that are kept.
    pub pins: Vec<Reading>,
    /// The last grid.
    pub grid: Option<Grid>,
    /// What the chosen patch sees.
    pub sight: Option<Arc<PatchSight>>,
    /// The recorded bake.
    pub recording: Option<Arc<Recording>>,
    /// Rays a pixel of the traced view; none where it is drawn.
    pub num_rays: Option<u32>,
    /// What is known to be wrong with the shadows of the last picture.
    pub fault: Option<String>,
    /// Points and directions from which its direct light comes.
    pub num_light_samples: usize,
}

impl Walkthrough {
    /// What is seen at a pixel of the window.
    pub(super) fn picked(&self, pixel: [f64; 2]) -> Option<Pick> {
        let place = self.session.place.as_ref()?;
        let [width, height] = self.picture_size.map(f64::from);
        let at = [(2.0 * pixel[0] / width - 1.0) as f32, (1.0 - 2.0 * pixel[1] / height) as f32];
        let eye = place.traveller.eye;
        let hidden = &self.panels.selection.hidden;
        let sees_back = !self.panels.light.see_through_backs;
        let direction = eye.direction(at, (width / height) as f32);
        // What is hidden is looked through, one surface at a time.
        let mut from = eye.position;
        for _ in 0..32 {
            let stops = |t| sees_back || place.scene.material_of(t).double_sided;
            let pick = place.collider.pick(from, direction, stops)?;
            if !hidden.contains(&place.scene.triangles[pick.triangle.index()].instance) {
                return Some(pick);
            }
            from = pick.point + 1e-4 * direction * (1.0 + (pick.point - eye.position).length());
        }
        None
    }

    /// A click in the picture with a tool in hand.
    pub(super) fn click(&mut self, pixel: [f64; 2]) {
        let Some(pick) = self.picked(pixel) else { return };
        let Some(place) = &self.session.place else { return };
        let instance = place.scene.triangles[pick.triangle.index()].instance;
        if self.panels.tool == Tool::Choose {
            self.panels.selection.chosen = Some(instance);
            let name = place.scene.instances.get(instance.index()).map_or("", |instance| &instance.name);
            self.panels.notice = Some(Notice::new(format!("Selected: {name}")));
            return;
        }
        let planar = &mut self.panels.light.shadows.planar;
        match self.panels.tool {
            Tool::Receiver => return planar.toggle_receiver(&place.scene, pick.triangle),
            Tool::Caster => return planar.toggle_caster(instance),
            _ => {}
        }
        let Some(solved) = place.solved.clone() else {
            self.panels.notice = Some(Notice::new("Wait for the light, then measure"));
            return;
        };
        let (job, gpu) = (self.session.job(), Arc::clone(&self.screen.gpu));
        let point = meter::point_of(&pick);
        let sent = match self.panels.tool {
            Tool::Meter => self.errands.send(Kind::Measure, job, move |bearer| {
                if let Some(reading) = meter::read(&solved, point, bearer) {
                    bearer.bring(Finding::Reading(Box::new(reading)));
                }
            }),
            Tool::Grid => {
                let plan = GridPlan::over(&place.scene, &pick, self.panels.grid.spacing, self.panels.grid.height);
                self.errands.send(Kind::Measure, job, move |bearer| {
                    if let Some(grid) = plan.measured(&solved, bearer) {
                        bearer.bring(Finding::Grid(Box::new(grid)));
                    }
                })
            }
            Tool::PatchView => {
                let render_settings = self.panels.light.render_settings(true);
                self.errands.send(Kind::Sight, job, move |bearer| {
                    match PatchSight::from(&gpu, &solved, point, &render_settings, bearer) {
                        Ok(Some(sight)) => bearer.bring(Finding::Sight(Arc::new(sight))),
                        Ok(None) => {}
                        Err(error) => bearer.bring(Finding::Written(Err(format!("{error:#}")))),
                    }
                })
            }
            Tool::Look | Tool::Choose | Tool::Receiver | Tool::Caster => Ok(()),
        };
        self.report(sent);
    }

    /// An errand has come back.
    pub(super) fn receive(&mut self, errand: u32, finding: Finding) {
        if self.errands.kind_of(errand).is_none() {
            return;
        }
        match finding {
            Finding::Reading(reading) => self.inquiry.last = Some(*reading),
            Finding::Grid(grid) => self.inquiry.grid = Some(*grid),
            Finding::Sight(sight) => self.inquiry.sight = Some(sight),
            Finding::Recording(recording) => {
                self.panels.replay.is_on = true;
                self.panels.replay.moment = 0;
                self.inquiry.recording = Some(recording);
            }
            Finding::Still(exposed) => {
                if self.screen.canvas.lay(&self.screen.gpu, &exposed) {
                    self.inquiry.num_rays = Some(exposed.num_rays);
                }
            }
            Finding::Written(Ok(path)) => {
                self.panels.notice = Some(Notice::new(format!("Written: {}", path.display())));
            }
            Finding::Written(Err(text)) => {
                self.panels.trouble = Some(Trouble { title: "This did not work".to_owned(), text });
            }
        }
    }

    /// What is known is of light that is no more: errands end, and nothing of what they have brought is shown.
    pub(super) fn forget(&mut self) {
        self.errands.end_all();
        self.panels.replay = Default::default();
        self.inquiry = Inquiry::default();
    }

    /// Does what the panels ask of readings, recordings and files.
    pub(super) fn inquire(&mut self, action: Action) {
        match action {
            Action::Take(tool) => self.take(tool),
            Action::Pin => self.inquiry.pins.extend(self.inquiry.last.take()),
            Action::ClearReadings => {
                (self.inquiry.last, self.inquiry.grid) = (None, None);
                self.inquiry.pins.clear();
            }
            Action::ClosePatchView => self.inquiry.sight = None,
            Action::WriteReadings => self.write_readings(),
            Action::ToggleRecording => self.toggle_recording(),
            Action::SaveBake => self.save_bake(),
            Action::WritePicture => self.write_picture(),
            Action::CancelPicture => self.errands.end(Kind::Write),
            _ => {}
        }
    }

    fn take(&mut self, tool: Tool) {
        self.look.release(&self.window);
        self.panels.tool = tool;
        let (tab, section) = match tool {
            Tool::Meter | Tool::Grid => (Tab::Meter, "Lux meter"),
            Tool::PatchView => (Tab::Meter, "View from here"),
            Tool::Choose => (Tab::Place, "Scene"),
            Tool::Receiver => {
                // One sees what is chosen.
                self.panels.light.debug = Some(DebugView::Receivers);
                return;
            }
            Tool::Caster | Tool::Look => return,
        };
        self.panels.memory.tab = tab;
        self.panels.memory.sections.insert(section.to_owned(), true);
    }

    fn write_readings(&mut self) {
        let readings: Vec<Reading> = self.inquiry.pins.iter().chain(&self.inquiry.last).cloned().collect();
        match meter::write_table(Path::new("."), &readings, self.inquiry.grid.as_ref()) {
            Ok(path) => self.panels.notice = Some(Notice::new(format!("Written: {}", path.display()))),
            Err(error) => self.report(Err(error)),
        }
    }

    fn toggle_recording(&mut self) {
        if self.errands.is_out(Kind::Record) {
            self.errands.end(Kind::Record);
            return;
        }
        let Some(solved) = self.solved() else { return };
        let sent =
            self.errands.send(Kind::Record, self.session.job(), move |bearer| match Recording::of(&solved, bearer) {
                Ok(Some(recording)) => bearer.bring(Finding::Recording(Arc::new(recording))),
                Ok(None) => {}
                Err(error) => bearer.bring(Finding::Written(Err(format!("{error:#}")))),
            });
        self.report(sent);
    }

    fn save_bake(&mut self) {
        let Some(solved) = self.solved() else { return };
        let ev = self.screen.canvas.metered_ev(&self.screen.gpu).unwrap_or(self.panels.light.ev);
        let sent = self.errands.send(Kind::Write, self.session.job(), move |bearer| {
            let stem = format!("{}-lit", solved.scene.name);
            let written = match next_name(Path::new("."), &stem, "glb") {
                Some(path) => baked::gltf::write(&path, &solved.baked, ev).map(|()| path).map_err(|e| e.to_string()),
                None => Err("there are a thousand bakes of this scene in this folder already".to_owned()),
            };
            bearer.bring(Finding::Written(written));
        });
        self.report(sent);
    }

    fn write_picture(&mut self) {
        let settings = self.panels.memory.picture;
        let Some(place) = &self.session.place else { return };
        let camera = place.traveller.eye.camera();
        let metered_ev = self.screen.canvas.metered_ev(&self.screen.gpu);
        let render_settings = still::held(&self.panels.light.render_settings(place.is_lit), metered_ev);
        let dials = self.panels.light.groups.clone();
        let (gpu, mesh, solved) = (Arc::clone(&self.screen.gpu), place.mesh.clone(), place.solved.clone());
        let sent = self.errands.send(Kind::Write, self.session.job(), move |bearer| {
            let picture = match (settings.num_rays, &solved) {
                (1.., Some(solved)) => Ok(output::traced(solved, &dials, &camera, &settings, &render_settings, bearer)),
                _ => output::drawn(&gpu, &mesh, &camera, settings.size, &render_settings).map(Some),
            };
            let written: anyhow::Result<Option<_>> = picture.and_then(|picture| {
                let Some(picture) = picture else { return Ok(None) };
                let path = settings.next_path(Path::new("."))?;
                picture.save(&path)?;
                Ok(Some(path))
            });
            let told: Option<Written> = written.map_err(|error| format!("{error:#}")).transpose();
            told.into_iter().for_each(|written| bearer.bring(Finding::Written(written)));
        });
        self.report(sent);
    }

    /// A picture of the window's size, at once.
    pub(super) fn take_picture(&mut self) {
        let Some(place) = &self.session.place else { return };
        let camera: Camera = place.traveller.eye.camera();
        let render_settings = self.panels.light.render_settings(place.is_lit);
        let drawn = output::drawn(&self.screen.gpu, &place.mesh, &camera, self.screen.size(), &render_settings);
        let written = drawn.and_then(|picture| {
            let path = output::PictureSettings::default().next_path(Path::new("."))?;
            picture.save(&path)?;
            Ok(path)
        });
        match written {
            Ok(path) => self.panels.notice = Some(Notice::new(format!("Written: {}", path.display()))),
            Err(error) => self.report(Err(error)),
        }
    }

    fn solved(&self) -> Option<Arc<super::solved::Solved>> {
        self.session.place.as_ref()?.solved.clone()
    }
}
