//! `hemicube render --reference`: how far a picture is from another one.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use glam::Vec3;

use crate::render::flip::magma;
use crate::render::{Picture, Raster, compare, save_display, visible_difference};

/// Tells how far the picture is from the reference, draws what an eye sees of it, and fails where it is too far.
pub(super) fn judge(
    picture: &Picture,
    reference: &Raster,
    output: &Path,
    threshold: f32,
    is_quiet: bool,
) -> Result<()> {
    let picture = Raster::of(picture, reference.kind);
    let difference = compare(&picture, reference)?;
    let seen = visible_difference(&picture, reference)?;
    let colours: Vec<Vec3> = seen.iter().map(|&seen| magma(seen)).collect();
    save_display(&difference_path(output), reference.size, &colours)?;
    let told = format!(
        "relative error {:.4}, mean {:+.2} %, FLIP {:.4}, {:.2} % of the pixels look different",
        difference.relative_rmse,
        100.0 * difference.mean_difference,
        seen.iter().sum::<f32>() / seen.len().max(1) as f32,
        100.0 * difference.perceptible_share
    );
    // A picture that holds a value that is no number is no good either.
    if difference.relative_rmse.is_nan() || difference.relative_rmse > threshold {
        bail!("{} differs from the reference: {told} (threshold {threshold})", output.display());
    }
    if !is_quiet {
        eprintln!("{}: {told}", output.display());
    }
    Ok(())
}

/// IMG-difference.png beside IMG.
fn difference_path(picture: &Path) -> PathBuf {
    let stem = picture.file_stem().unwrap_or_default().to_string_lossy();
    picture.with_file_name(format!("{stem}-difference.png"))
}
