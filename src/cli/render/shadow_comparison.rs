//! `hemicube render --compare-shadows`: where two shadow techniques differ.

use std::path::Path;
use std::sync::Arc;

use anyhow::Result;

use super::view_request::ViewRequest;
use crate::baked::BakedScene;
use crate::gpu::Gpu;
use crate::render::scene::SceneBuffers;
use crate::render::shadow::{ComparedScene, ShadowComparison};
use crate::render::{ShadowScene, ShadowSettings, View, save_display};

/// Writes a picture of the difference between two techniques and prints the share of pixels that differ.
///
/// # Errors
/// Returns an error if the picture cannot be drawn or written.
pub fn compare_shadows(
    gpu: &Gpu,
    baked: BakedScene,
    request: &ViewRequest,
    [a, b]: &[ShadowSettings; 2],
    output: &Path,
) -> Result<()> {
    let size = request.size;
    let buffers = SceneBuffers::new(gpu, &baked);
    let shadows = ShadowScene::new(gpu, Arc::new(baked.scene));
    let view = View::from_camera(&request.camera, size[0] as f32 / size[1] as f32);
    let compared = ComparedScene { scene: &buffers, shadows: &shadows, view: &view, size };
    let (difference, reference) = ShadowComparison::new(gpu).compare(gpu, compared, a, b)?;
    save_display(output, size, &difference.picture(&reference))?;
    let num_pixels = difference.count.iter().filter(|&&count| count > 0).count();
    println!("{num_pixels} of {} pixels differ", difference.count.len());
    println!("shadow difference: {:.3} %", 100.0 * difference.share);
    Ok(())
}
