//! Clicks in the picture.

use std::sync::Arc;

use crate::viewer::camera::collider::Pick;
use crate::viewer::job::{JobKind, JobResult};
use crate::viewer::settings::tool::Tool;
use crate::viewer::solution::meter::{self, GridPlan};
use crate::viewer::solution::patch_view::ChosenPatchView;
use crate::viewer::solution::solved::SolvedScene;
use crate::viewer::window::viewer::Viewer;

/// Largest number of hidden surfaces that a pick passes through.
const MAX_HIDDEN: usize = 32;

impl Viewer {
    /// Returns the visible surface at a pixel of the window.
    pub fn pick(&self, pixel: [f64; 2]) -> Option<Pick> {
        let open_scene = self.session.open_scene.as_ref()?;
        let [width, height] = self.picture.size.map(f64::from);
        let at = [(2.0 * pixel[0] / width - 1.0) as f32, (1.0 - 2.0 * pixel[1] / height) as f32];
        let pose = open_scene.controller.pose;
        let hidden = &self.panels.selection.hidden;
        let sees_back = !self.panels.light.see_through_backs;
        let direction = pose.direction(at, (width / height) as f32);
        // The ray is continued behind each surface of a hidden instance.
        let mut from = pose.position;
        for _ in 0..MAX_HIDDEN {
            let is_opaque = |t| sees_back || open_scene.scene.material_of(t).double_sided;
            let pick = open_scene.collider.pick(from, direction, is_opaque)?;
            if !hidden.contains(&open_scene.scene.triangles[pick.triangle.index()].instance) {
                return Some(pick);
            }
            from = pick.point + 1e-4 * direction * (1.0 + (pick.point - pose.position).length());
        }
        None
    }

    /// Applies the selected tool to the surface at a pixel.
    pub fn on_click(&mut self, pixel: [f64; 2]) {
        let Some(pick) = self.pick(pixel) else { return };
        let Some(open_scene) = &self.session.open_scene else { return };
        let scene = Arc::clone(&open_scene.scene);
        let instance = scene.triangles[pick.triangle.index()].instance;
        let planar = &mut self.panels.light.shadows.planar;
        match self.panels.tool {
            Tool::Look => {}
            Tool::Choose => {
                self.panels.selection.chosen = Some(instance);
                let name = scene.instances.get(instance.index()).map_or("", |instance| &instance.name);
                self.notify(format!("Selected: {name}"));
            }
            Tool::Receiver => planar.toggle_receiver(&scene, pick.triangle),
            Tool::Caster => planar.toggle_caster(instance),
            Tool::Meter | Tool::Grid | Tool::PatchView => match open_scene.solved.clone() {
                Some(solved) => self.measure(solved, pick),
                None => self.notify("Wait for the light, then measure"),
            },
        }
    }

    /// Starts the measurement of the selected tool at a picked surface.
    fn measure(&mut self, solved: Arc<SolvedScene>, pick: Pick) {
        let point = meter::point_of(&pick);
        let started = match self.panels.tool {
            Tool::Meter => self.jobs.start(JobKind::Measure, move |job| {
                if let Some(reading) = meter::read(&solved, point, job) {
                    job.send(JobResult::Reading(Box::new(reading)));
                }
            }),
            Tool::Grid => {
                let Some(open_scene) = &self.session.open_scene else { return };
                let plan = GridPlan::over(&open_scene.scene, &pick, self.panels.grid.spacing, self.panels.grid.height);
                self.jobs.start(JobKind::Measure, move |job| {
                    if let Some(grid) = plan.measure(&solved, job) {
                        job.send(JobResult::Grid(Box::new(grid)));
                    }
                })
            }
            Tool::PatchView => {
                let render_settings = self.panels.light.render_settings(true);
                let gpu = Arc::clone(&self.surface.gpu);
                self.jobs.start(JobKind::PatchView, move |job| {
                    match ChosenPatchView::compute(&gpu, &solved, point, &render_settings, job) {
                        Ok(Some(view)) => job.send(JobResult::PatchView(Arc::new(view))),
                        Ok(None) => {}
                        Err(error) => job.send(JobResult::failed(&error)),
                    }
                })
            }
            Tool::Look | Tool::Choose | Tool::Receiver | Tool::Caster => Ok(()),
        };
        self.report(started);
    }
}
