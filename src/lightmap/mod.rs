//! Floor 3: the light of a bake as a texture.
//!
//! Follows on a bake where a program wants light so: the scene as it was loaded is laid flat (`layout`), each element is
//! drawn where its part of the scene came to lie, with its light between the vertices (`texels`), and the whole is compared
//! with what it was made from (`deviation`). Deliberately absent: files, and the unwrapping itself, for which there is a
//! well-kept crate.

mod deviation;
mod layout;
mod pieces;
mod texels;

use thiserror::Error;

use layout::Layout;

use crate::baked::{Lightmap, VertexLight};
use crate::patch::PatchMesh;
use crate::scene::Scene;

/// How fine and how large a lightmap may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightmapSettings {
    /// Width of a texel on the surfaces, metres; larger where the texture would be larger than it may.
    pub texel_size: f32,
    /// Most texels across and down.
    pub max_side: u32,
}

/// Texels along an element of the longest edge. Elements at the edges of shadows are up to 32 times as short.
const TEXELS_AN_ELEMENT: f32 = 16.0;

/// A texture that every graphics card takes.
const MAX_SIDE: u32 = 4096;

impl LightmapSettings {
    /// What suits a bake of this element size, metres.
    #[must_use]
    pub fn for_elements(element_size: f32) -> Self {
        Self { texel_size: element_size / TEXELS_AN_ELEMENT, max_side: MAX_SIDE }
    }
}

/// A lightmap could not be made.
#[derive(Debug, Error)]
pub enum LightmapError {
    /// The unwrapper refused.
    #[error("the scene cannot be laid flat: {0}")]
    Unwrap(#[from] uvunwrap::Error),
    /// Even with the largest texels there is no room.
    #[error("a lightmap of {side} x {side} texels has no room for the {charts} pieces that the scene falls into")]
    TooManyCharts {
        /// Pieces that hang together.
        charts: u32,
        /// Most texels across and down.
        side: u32,
    },
}

/// The light of a bake of `scene`, on the elements of `mesh`, as a texture.
///
/// A texel holds the mean of the light on its part of the surface, so that hard edges of shadows have no steps. What no surface
/// covers takes the light of the nearest that is covered: between the centres of texels nothing foreign is mixed in.
///
/// # Errors
/// The scene falls into more pieces than the texture has room for.
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
