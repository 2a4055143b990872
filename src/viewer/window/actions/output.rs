//! Actions that write files: pictures, bakes, readings.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::Context;

use crate::baked;
use crate::render::Picture;
use crate::viewer::drawing::picture_file::{self, next_path};
use crate::viewer::job::JobKind;
use crate::viewer::session::open_scene::OpenScene;
use crate::viewer::settings::picture_file::PictureSettings;
use crate::viewer::solution::file_names::next_free_name;
use crate::viewer::solution::meter;
use crate::viewer::solution::solved::SolvedScene;
use crate::viewer::solution::traced_view::{TracedViewRequest, with_fixed_exposure};
use crate::viewer::window::viewer::Viewer;

impl Viewer {
    /// Writes the readings and the grid as a table.
    pub(super) fn write_readings(&mut self) {
        let measurements = &self.results.measurements;
        let written = meter::write_table(Path::new("."), &measurements.readings(), measurements.grid.as_ref());
        self.report_written(written);
    }

    /// Starts a job that writes the bake.
    pub(super) fn save_bake(&mut self) {
        let Some(solved) = self.solved() else { return };
        let ev = self.metered_ev().unwrap_or(self.panels.light.ev);
        let started = self.jobs.start(JobKind::Write, move |job| job.send(write_bake(&solved, ev).into()));
        self.report(started);
    }

    /// Starts a job that writes a picture with the settings of the panel.
    pub(super) fn write_picture(&mut self) {
        let settings = self.panels.preferences.picture;
        let Some(OpenScene { controller, uploaded, solved, is_lit, .. }) = &self.session.open_scene else { return };
        let view = TracedViewRequest {
            camera: controller.pose.camera(),
            size: settings.size,
            settings: with_fixed_exposure(&self.panels.light.render_settings(*is_lit), self.metered_ev()),
            dials: self.panels.light.groups.clone(),
        };
        let (gpu, uploaded, solved) = (Arc::clone(&self.surface.gpu), uploaded.clone(), solved.clone());
        let started = self.jobs.start(JobKind::Write, move |job| {
            let picture = match (settings.num_rays, &solved) {
                (num_rays @ 1.., Some(solved)) => Ok(picture_file::traced(solved, &view, num_rays, job)),
                _ => picture_file::drawn(&gpu, &uploaded, &view.camera, view.size, &view.settings).map(Some),
            };
            // A cancelled picture is `None` and leaves no file.
            if let Some(picture) = picture.transpose() {
                job.send(picture.and_then(|picture| save(&picture, &settings)).into());
            }
        });
        self.report(started);
    }

    /// Writes a picture of the size of the window at once.
    pub(super) fn take_screenshot(&mut self) {
        let Some(OpenScene { controller, uploaded, is_lit, .. }) = &self.session.open_scene else { return };
        let camera = controller.pose.camera();
        let render_settings = self.panels.light.render_settings(*is_lit);
        let picture = picture_file::drawn(&self.surface.gpu, uploaded, &camera, self.surface.size(), &render_settings);
        let written = picture.and_then(|picture| save(&picture, &PictureSettings::default()));
        self.report_written(written);
    }
}

/// Writes the bake into the current folder as the next free `SCENE-lit-NNN.glb`.
fn write_bake(solved: &SolvedScene, ev: f32) -> anyhow::Result<PathBuf> {
    let stem = format!("{}-lit", solved.scene.name);
    let path = next_free_name(Path::new("."), &stem, "glb")
        .context("there are a thousand bakes of this scene in this folder already")?;
    baked::gltf::write(&path, &solved.baked, ev)?;
    Ok(path)
}

/// Writes a picture into the current folder.
fn save(picture: &Picture, settings: &PictureSettings) -> anyhow::Result<PathBuf> {
    let path = next_path(Path::new("."), settings)?;
    picture.save(&path)?;
    Ok(path)
}
