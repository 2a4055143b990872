//! Floor 3: the light of a bake as a texture (a lightmap).
//!
//! For programs that read light from a texture: the scene as it was loaded is unwrapped (`layout`), each element is
//! drawn where its part of the scene lies in the texture, with its light interpolated between the vertices (`pieces`,
//! `texels`), and the result is compared with the light at the vertices (`deviation`). Deliberately absent: files
//! ([`crate::baked::gltf`]), and the unwrapping itself, which a crate does.

mod deviation;
mod layout;
mod pieces;
mod settings;
mod texels;

use layout::Layout;

use crate::baked::{Lightmap, VertexLight};
use crate::patch::PatchMesh;
use crate::scene::Scene;

pub use settings::{LightmapError, LightmapSettings};

/// Draws the light of a bake of `scene`, on the elements of `mesh`, into a texture.
///
/// A texel holds the mean of the light on its part of the surface, so hard edges of shadows have no steps. A texel that
/// no surface covers takes the light of the nearest covered one, so that bilinear filtering mixes in no other light.
///
/// # Errors
/// Returns an error if the scene cannot be unwrapped, or falls into more pieces than the texture has room for.
pub fn lightmap(
    scene: &Scene,
    mesh: &PatchMesh,
    light: &VertexLight,
    settings: &LightmapSettings,
) -> Result<Lightmap, LightmapError> {
    let layout = layout::lay_flat(scene, settings)?;
    let pieces = || pieces::pieces(&layout, mesh, light);
    let texels = texels::draw(layout.size, pieces);
    let deviation = deviation::deviation(&texels, pieces());
    let Layout { scene, coordinates, texel_size, .. } = layout;
    Ok(Lightmap { scene, coordinates, texels, texel_size, deviation })
}

#[cfg(test)]
mod tests;
