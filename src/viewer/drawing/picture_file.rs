//! Pictures that are written to files.

use std::path::{Path, PathBuf};

use anyhow::Context;

use crate::base::progress::Progress;
use crate::gpu::Gpu;
use crate::raytrace::{Ambient, TwoPassSettings, two_pass};
use crate::render::{Picture, PictureRequest, RenderSettings, draw_picture, tone_map_on_cpu};
use crate::scene::Camera;
use crate::trace::Tracer;
use crate::viewer::drawing::scene_renderer::SAMPLES;
use crate::viewer::picture::uploaded_scene::UploadedScene;
use crate::viewer::settings::picture_file::PictureSettings;
use crate::viewer::solution::file_names::next_free_name;
use crate::viewer::solution::solved::SolvedScene;
use crate::viewer::solution::traced_view::TracedViewRequest;

/// Returns the next free name of a picture in `folder`.
///
/// # Errors
/// Returns an error if all 999 names are taken.
pub fn next_path(folder: &Path, settings: &PictureSettings) -> anyhow::Result<PathBuf> {
    next_free_name(folder, "hemicube", settings.ending())
        .context("there are a thousand pictures in this folder already")
}

/// Draws the view by rasterisation.
///
/// # Errors
/// Returns an error if the device cannot draw a picture of this size, or is lost.
pub fn drawn(
    gpu: &Gpu,
    scene: &UploadedScene,
    camera: &Camera,
    size: [u32; 2],
    render_settings: &RenderSettings,
) -> anyhow::Result<Picture> {
    let request = PictureRequest::new(&scene.buffers, camera, size, render_settings);
    Ok(draw_picture(gpu, &PictureRequest { shadows: Some(&scene.shadows), ..request }, SAMPLES)?)
}

/// Traces the view with `num_rays` rays per pixel; `None` if it was cancelled.
#[must_use]
pub fn traced(
    solved: &SolvedScene,
    request: &TracedViewRequest,
    num_rays: u32,
    progress: &dyn Progress,
) -> Option<Picture> {
    let TracedViewRequest { camera, size, settings, dials } = request;
    let baked = solved.dimmed(dials);
    let tracer = Tracer::new(&baked.scene);
    let ambient = Ambient::Indirect { final_gather: 0 };
    let rays = TwoPassSettings { samples: num_rays, ambient, seed: 0 };
    let film = two_pass(&tracer, &baked, camera, *size, &rays, progress);
    (!progress.is_cancelled()).then(|| tone_map_on_cpu(film.size(), film.radiance(), settings))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_numbered() {
        let folder = tempfile::tempdir().expect("a folder");
        let name = || {
            let path = next_path(folder.path(), &PictureSettings::default()).expect("few pictures");
            path.file_name().map(|name| name.to_string_lossy().into_owned())
        };
        assert_eq!(name().as_deref(), Some("hemicube-001.png"));
        std::fs::write(folder.path().join("hemicube-001.png"), "").expect("written");
        assert_eq!(name().as_deref(), Some("hemicube-002.png"));
    }
}
