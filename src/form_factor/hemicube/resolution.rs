//! Computes the number of pixels that a hemicube needs to resolve patches.
//!
//! Source: Baum, Rushmeier, Winget 1989, "Improving radiosity solutions through the use of analytically determined
//! form-factors" (the aliasing assumption).

use crate::patch::PatchMesh;
use crate::scene::Scene;

/// Width of a patch at the middle of a face, pixels.
const PIXELS_A_PATCH: f32 = 1.5;

/// Share of the area that may lie in patches too small to be resolved.
const UNRESOLVED_SHARE: f32 = 0.1;

/// Smallest and largest width that is chosen, pixels.
const USUAL_SIZES: [u32; 2] = [32, 256];

/// Returns the width of hemicubes, pixels: a power of two at which a typical patch, seen from half the diagonal of the
/// scene, is about 1.5 pixels wide.
#[must_use]
pub fn size_for_patches(scene: &Scene, mesh: &PatchMesh) -> u32 {
    let distance = scene.bounds().diagonal() / 2.0;
    // A face is 2 wide at distance 1.
    let pixels = 2.0 * PIXELS_A_PATCH * distance / typical_area(mesh).sqrt();
    let [fewest, most] = USUAL_SIZES;
    fewest << (pixels / fewest as f32).log2().round().clamp(0.0, (most / fewest).ilog2() as f32) as u32
}

/// Returns the patch area below which only [`UNRESOLVED_SHARE`] of all area lies.
fn typical_area(mesh: &PatchMesh) -> f32 {
    let mut areas: Vec<f32> = mesh.patches.iter().map(|patch| patch.area).collect();
    areas.sort_unstable_by(f32::total_cmp);
    let small = UNRESOLVED_SHARE * areas.iter().sum::<f32>();
    let mut sum = 0.0;
    let typical = areas.iter().find(|&&area| {
        sum += area;
        sum > small
    });
    typical.copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::patch::MeshSettings;
    use crate::scene::builtin;

    fn size(scene: &Scene, patch_size: f32) -> u32 {
        let mesh = PatchMesh::new(scene, &MeshSettings { element_size: patch_size / 4.0, patch_size }).expect("a mesh");
        size_for_patches(scene, &mesh)
    }

    #[test]
    fn smaller_patches_need_more_pixels() {
        let scene = builtin::cornell();
        let sizes = [1.6, 0.4, 0.1].map(|patch_size| size(&scene, patch_size));
        assert_eq!(sizes, [32, 64, 128]);
    }
}
