//! F12: a picture of the view, without the panels, beside the ones that were taken before.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::Context;

use super::canvas::SAMPLES;
use super::session::Place;
use crate::gpu::Gpu;
use crate::render::{Look, picture_in_light};
use crate::scene::Camera;

/// Draws the view once more and writes it into `folder` as the next `hemicube-NNN.png`.
///
/// # Errors
/// The GPU was lost or the file cannot be written.
pub fn take(
    gpu: &Gpu,
    place: &Place,
    camera: &Camera,
    size: [u32; 2],
    look: &Look,
    folder: &Path,
) -> anyhow::Result<PathBuf> {
    let picture = picture_in_light(gpu, &place.buffers, Some(Arc::clone(&place.shadows)), camera, size, look, SAMPLES)?;
    let path = next_name(folder).context("there are a thousand pictures in this folder already")?;
    picture.save(&path)?;
    Ok(path)
}

/// The first name that no file has yet.
fn next_name(folder: &Path) -> Option<PathBuf> {
    (1..1000).map(|number| folder.join(format!("hemicube-{number:03}.png"))).find(|path| !path.exists())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_counted_on() {
        let folder = tempfile::tempdir().expect("a folder");
        let name = |path: Option<PathBuf>| path.and_then(|path| Some(path.file_name()?.to_str()?.to_owned()));
        assert_eq!(name(next_name(folder.path())).as_deref(), Some("hemicube-001.png"));
        std::fs::write(folder.path().join("hemicube-001.png"), "").expect("written");
        assert_eq!(name(next_name(folder.path())).as_deref(), Some("hemicube-002.png"));
    }
}
