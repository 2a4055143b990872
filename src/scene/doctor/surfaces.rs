//! Defects of materials and textures: implausible reflectance, missing images.

use super::finding::{Finding, FindingKind, Location};
use crate::base::ids::TriangleId;
use crate::scene::reflectance::mean_reflectances;
use crate::scene::{Scene, Texture};

/// Highest plausible mean reflectance: fresh snow reflects 0.9, white paint 0.85.
const PLAUSIBLE_REFLECTANCE: f32 = 0.9;

/// Finds used materials with a mean reflectance above 0.9, located at the triangles that use them.
pub(super) fn bright_materials(scene: &Scene) -> Finding {
    let reflectances = mean_reflectances(scene);
    let is_bright = |t: &usize| reflectances[scene.triangles[*t].material.index()] > PLAUSIBLE_REFLECTANCE;
    let bright: Vec<usize> = (0..scene.triangles.len()).filter(is_bright).collect();
    let mut materials: Vec<_> = bright.iter().map(|&t| scene.triangles[t].material.index()).collect();
    materials.sort_unstable();
    materials.dedup();
    let names: Vec<_> = materials.iter().map(|&m| scene.materials[m].name.as_str()).collect();
    let mut finding = Finding::new(FindingKind::BrightMaterial);
    finding.detail = names.join(", ");
    finding.count = materials.len();
    finding.show(bright.into_iter().map(|t| Location::triangle(scene.corners(TriangleId::new(t)))));
    finding
}

/// Finds textures whose image cannot be read.
pub(super) fn missing_textures(scene: &Scene) -> Finding {
    let is_missing = |texture: &&Texture| texture.image.encoded.is_empty();
    Finding { count: scene.textures.iter().filter(is_missing).count(), ..Finding::new(FindingKind::MissingTexture) }
}
