//! `hemicube render --reference`: the difference between a picture and a reference.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use glam::Vec3;

use crate::cli::terminal::Terminal;
use crate::render::compare::magma;
use crate::render::{Picture, Raster, compare, save_display, visible_difference};

/// Compares the picture with the reference, and writes the visible difference (FLIP) beside it.
///
/// # Errors
/// Returns an error if the relative error exceeds the threshold, the sizes differ, or the difference cannot be written.
pub fn compare_with_reference(
    picture: &Picture,
    reference: &Raster,
    threshold: f32,
    output: &Path,
    terminal: Terminal,
) -> Result<()> {
    let picture = Raster::of(picture, reference.kind);
    let difference = compare(&picture, reference)?;
    let flip = visible_difference(&picture, reference)?;
    let colours: Vec<Vec3> = flip.iter().map(|&error| magma(error)).collect();
    save_display(&difference_path(output), reference.size, &colours)?;
    let summary = format!(
        "relative error {:.4}, mean {:+.2} %, FLIP {:.4}, {:.2} % of the pixels look different",
        difference.relative_rmse,
        100.0 * difference.mean_difference,
        flip.iter().sum::<f32>() / flip.len().max(1) as f32,
        100.0 * difference.perceptible_share
    );
    // The error is NaN if the picture holds a NaN.
    if difference.relative_rmse.is_nan() || difference.relative_rmse > threshold {
        bail!("{} differs from the reference: {summary} (threshold {threshold})", output.display());
    }
    terminal.print(format_args!("{}: {summary}", output.display()));
    Ok(())
}

/// Returns the path IMG-difference.png beside IMG.
fn difference_path(picture: &Path) -> PathBuf {
    let stem = picture.file_stem().unwrap_or_default().to_string_lossy();
    picture.with_file_name(format!("{stem}-difference.png"))
}
