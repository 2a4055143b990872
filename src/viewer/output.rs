//! Files that the window writes: pictures, bakes, tables; and the camera as flags of the command line.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::Context;

use super::camera::Eye;
use super::painter::SAMPLES;
use super::solved::Solved;
use crate::base::progress::Progress;
use crate::gpu::Gpu;
use crate::raytrace::{Ambient, TwoPassSettings, two_pass};
use crate::render::{Picture, RenderSettings, ShadowScene, picture_in_light, tone_map_on_cpu};
use crate::scene::Camera;
use crate::trace::Tracer;

use super::settings::GroupDial;
use super::worker::Mesh;

/// A file that has been written, or why it has not.
pub type Written = Result<PathBuf, String>;

/// How a large picture is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct PictureSettings {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Linear radiance as .exr and not what is displayed as .png.
    pub is_exr: bool,
    /// Rays a pixel; 0 draws by raster.
    pub num_rays: u32,
}

impl Default for PictureSettings {
    fn default() -> Self {
        Self { size: [1920, 1080], is_exr: false, num_rays: 0 }
    }
}

impl PictureSettings {
    /// The next name of such a picture in `folder`.
    ///
    /// # Errors
    /// There are a thousand already.
    pub fn next_path(&self, folder: &Path) -> anyhow::Result<PathBuf> {
        let ending = if self.is_exr { "exr" } else { "png" };
        next_name(folder, "hemicube", ending).context("there are a thousand pictures in this folder already")
    }
}

/// The first of `STEM-001.ENDING`, `STEM-002.ENDING` ... that no file has yet.
#[must_use]
pub fn next_name(folder: &Path, stem: &str, ending: &str) -> Option<PathBuf> {
    (1..1000).map(|number| folder.join(format!("{stem}-{number:03}.{ending}"))).find(|path| !path.exists())
}

/// Draws the view.
///
/// # Errors
/// The size is more than the device can draw, or the device was lost.
pub fn drawn(
    gpu: &Gpu,
    mesh: &Mesh,
    camera: &Camera,
    size: [u32; 2],
    render_settings: &RenderSettings,
) -> anyhow::Result<Picture> {
    let shadows: Option<Arc<ShadowScene>> = Some(Arc::clone(&mesh.shadows));
    Ok(picture_in_light(gpu, &mesh.buffers, shadows, camera, size, render_settings, SAMPLES)?)
}

/// Traces the view, `num_rays` rays a pixel; none where it was cancelled.
#[must_use]
pub fn traced(
    solved: &Solved,
    dials: &[GroupDial],
    camera: &Camera,
    settings: &PictureSettings,
    render_settings: &RenderSettings,
    progress: &dyn Progress,
) -> Option<Picture> {
    let baked = solved.dimmed(dials);
    let tracer = Tracer::new(&baked.scene);
    let ambient = Ambient::Indirect { final_gather: 0 };
    let rays = TwoPassSettings { samples: settings.num_rays, ambient, seed: 0 };
    let film = two_pass(&tracer, &baked, camera, settings.size, &rays, progress);
    (!progress.is_cancelled()).then(|| tone_map_on_cpu(film.size(), film.radiance(), render_settings))
}

/// The eye as an option of `hemicube render`.
#[must_use]
pub fn camera_flag(eye: &Eye) -> String {
    let (p, f) = (eye.position, eye.forward());
    let numbers = [p.x, p.y, p.z, f.x, f.y, f.z].map(|number| format!("{number:.4}")).join(",");
    format!("--eye={numbers},{:.2}", eye.fov_y.to_degrees())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn files_are_counted_on() {
        let folder = tempfile::tempdir().expect("a folder");
        let name = || {
            let path = PictureSettings::default().next_path(folder.path()).expect("few pictures");
            path.file_name().map(|name| name.to_string_lossy().into_owned())
        };
        assert_eq!(name().as_deref(), Some("hemicube-001.png"));
        std::fs::write(folder.path().join("hemicube-001.png"), "").expect("written");
        assert_eq!(name().as_deref(), Some("hemicube-002.png"));
    }

    #[test]
    fn the_flag_names_place_direction_and_angle() {
        let eye = Eye::looking_along(Vec3::new(1.0, 1.65, -2.0), Vec3::NEG_Z);
        assert_eq!(camera_flag(&eye), "--eye=1.0000,1.6500,-2.0000,0.0000,0.0000,-1.0000,60.00");
    }
}
