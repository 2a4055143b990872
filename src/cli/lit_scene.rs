//! The light of a loaded scene: stored in the file, or baked now.

use anyhow::Result;

use super::terminal::Terminal;
use crate::bake::{Bake, BakeContext, BakeSettings, Method, bake_with};
use crate::baked::{self, BakedScene};
use crate::form_factor::row_cache::RowCache;
use crate::gpu::Gpu;
use crate::scene::Scene;

/// Opens the device that draws the hemicubes of a bake; `None` if the bake uses rays.
///
/// # Errors
/// Returns an error if the settings require hemicubes and there is no driver.
pub fn bake_device(settings: &BakeSettings) -> Result<Option<Gpu>> {
    if settings.method == Some(Method::Hemisphere) {
        return Ok(None);
    }
    match Gpu::headless() {
        Ok(gpu) => Ok(Some(gpu)),
        Err(error) if settings.method.is_none() => {
            log::warn!("{error}; form factors come from rays instead");
            Ok(None)
        }
        Err(error) => Err(error.into()),
    }
}

/// Bakes with progress on the terminal. Ctrl-C ends the bake after the current batch; the light solved so far remains.
///
/// # Errors
/// Returns an error if the scene cannot be baked.
pub fn bake_watched(
    gpu: Option<&Gpu>,
    scene: &Scene,
    settings: &BakeSettings,
    rows: Option<&RowCache>,
    terminal: Terminal,
) -> Result<Bake> {
    let watch = terminal.watch()?;
    let bake = bake_with(scene, settings, &BakeContext { gpu, row_cache: rows, observer: &watch })?;
    watch.finish();
    for note in &scene.notes {
        log::info!("{note}");
    }
    Ok(bake)
}

/// Returns a loaded scene with its light: the stored light, or a bake made now.
///
/// # Errors
/// Returns an error if the scene cannot be baked.
pub fn lit_scene(gpu: Option<&Gpu>, scene: Scene, settings: &BakeSettings, terminal: Terminal) -> Result<BakedScene> {
    match baked::gltf::from_scene(scene) {
        Ok(baked) => Ok(baked),
        Err(scene) => Ok(bake_watched(gpu, &scene, settings, None, terminal)?.baked),
    }
}
