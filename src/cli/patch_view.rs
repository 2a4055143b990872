//! `hemicube render --hemicube-at`: what a patch sees.

use std::path::Path;

use anyhow::Result;
use glam::Vec3;

use super::render::{RenderArgs, light, render_settings};
use crate::bake::patch_view::patch_view;
use crate::base::sampling::{hash, unit_float};
use crate::gpu::Gpu;
use crate::radiosity::sites::Sites;
use crate::raytrace::MeasuringPoint;
use crate::render::develop;
use crate::render::picture::save_display;
use crate::scene::Scene;

/// Width of the hemicube, pixels.
const SIZE_PX: u32 = 256;

/// Parses X,Y,Z,NX,NY,NZ.
pub fn patch_viewpoint(text: &str) -> Result<MeasuringPoint, String> {
    let numbers: Option<Vec<f32>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    let numbers =
        numbers.and_then(|numbers| <[f32; 6]>::try_from(numbers).ok()).filter(|n| n.iter().all(|x| x.is_finite()));
    let [x, y, z, nx, ny, nz] = numbers.ok_or("must be six numbers, X,Y,Z,NX,NY,NZ")?;
    let normal = Vec3::new(nx, ny, nz).try_normalize().ok_or("the normal has no direction")?;
    Ok(MeasuringPoint { position: Vec3::new(x, y, z), normal })
}

/// Draws and writes the view from `at`, shaded and as elements.
pub(super) fn view_from_patch(scene: Scene, at: &MeasuringPoint, args: &RenderArgs, is_quiet: bool) -> Result<()> {
    let gpu = Gpu::headless()?;
    let baked = light(&gpu, scene, args, is_quiet)?;
    // Seed 0: the same place gives the same picture.
    let viewpoint = Sites::new(&baked.scene).viewpoint(at.position, at.normal, 0);
    let view = patch_view(&gpu, &baked, &viewpoint, SIZE_PX)?;
    develop(view.size, view.radiance, &render_settings(args, &baked)).save(&args.output)?;
    let colours: Vec<Vec3> = view.items.iter().map(|item| item.map_or(Vec3::ZERO, item_colour)).collect();
    Ok(save_display(&items_path(&args.output), view.size, &colours)?)
}

/// A colour that tells an element from its neighbours.
fn item_colour(element: u32) -> Vec3 {
    let channel = |i: u32| 0.05 + 0.9 * unit_float(hash(hash(element) ^ i));
    Vec3::new(channel(0), channel(1), channel(2))
}

/// IMG-items.png beside IMG.
fn items_path(picture: &Path) -> std::path::PathBuf {
    let stem = picture.file_stem().unwrap_or_default().to_string_lossy();
    picture.with_file_name(format!("{stem}-items.png"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_read_or_refused() {
        let point = patch_viewpoint("1,-2, 3.5,0,0,2").expect("six numbers");
        assert_eq!((point.position, point.normal), (Vec3::new(1.0, -2.0, 3.5), Vec3::Z));
        for wrong in ["", "1,2,3", "1,2,3,0,0,0", "1,2,3,a,0,1", "1,2,3,0,0,1,0", "inf,0,0,0,0,1"] {
            assert!(patch_viewpoint(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_picture_of_elements_lies_beside_the_other() {
        assert_eq!(items_path(Path::new("out/view.exr")), Path::new("out/view-items.png"));
    }
}
