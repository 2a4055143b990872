//! `hemicube render --hemicube-at`: the view from a patch.

use std::path::{Path, PathBuf};

use anyhow::Result;
use glam::Vec3;

use super::light::{raster_light, render_settings};
use super::options::RenderArgs;
use crate::bake::patch_view::patch_view;
use crate::base::sampling::{hash, unit_float};
use crate::cli::terminal::Terminal;
use crate::gpu::Gpu;
use crate::radiosity::Viewpoints;
use crate::raytrace::MeasuringPoint;
use crate::render::picture::save_display;
use crate::render::tone_map_on_cpu;
use crate::scene::Scene;

/// Width of the hemicube, pixels.
const SIZE_PX: u32 = 256;

/// Draws and writes the view from `at`: shaded, and with a colour for each element.
///
/// # Errors
/// Returns an error if the scene cannot be baked or a picture cannot be drawn or written.
pub fn write_patch_view(scene: Scene, at: &MeasuringPoint, args: &RenderArgs, terminal: Terminal) -> Result<()> {
    let gpu = Gpu::headless()?;
    let baked = raster_light(&gpu, scene, args, terminal)?;
    // A fixed seed gives the same picture each time.
    let viewpoint = Viewpoints::new(&baked.scene).above(at.position, at.normal, 0);
    let view = patch_view(&gpu, &baked, &viewpoint, SIZE_PX)?;
    tone_map_on_cpu(view.size, view.radiance, &render_settings(args, &baked)).save(&args.output)?;
    let colours: Vec<Vec3> = view.items.iter().map(|item| item.map_or(Vec3::ZERO, item_colour)).collect();
    Ok(save_display(&items_path(&args.output), view.size, &colours)?)
}

/// Returns a colour that differs from those of neighbouring elements.
fn item_colour(element: u32) -> Vec3 {
    let channel = |i: u32| 0.05 + 0.9 * unit_float(hash(hash(element) ^ i));
    Vec3::new(channel(0), channel(1), channel(2))
}

/// Returns the path IMG-items.png beside IMG.
fn items_path(picture: &Path) -> PathBuf {
    let stem = picture.file_stem().unwrap_or_default().to_string_lossy();
    picture.with_file_name(format!("{stem}-items.png"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_picture_of_elements_lies_beside_the_other() {
        assert_eq!(items_path(Path::new("out/view.exr")), Path::new("out/view-items.png"));
    }
}
