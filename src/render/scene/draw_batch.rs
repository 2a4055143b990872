//! Triangles that are drawn in one call, and the chunks that culling selects from them.

use std::ops::Range;

use crate::base::bounds::Bounds;
use crate::base::ids::MaterialId;
use crate::scene::AlphaMode;

/// Triangles that are drawn in one call.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawBatch {
    /// Range of their indices in the index buffer.
    pub indices: Range<u32>,
    /// Their material.
    pub material: MaterialId,
    /// Alpha mode of the material.
    pub alpha_mode: AlphaMode,
    /// Faces of the triangles that are surfaces.
    pub faces: Faces,
    /// True if the material has textures.
    pub has_textures: bool,
    /// True if the material shows its base colour without light (`KHR_materials_unlit`).
    pub is_unlit: bool,
    /// True if the light is in tiles, false if it is at the vertices.
    pub is_tiled: bool,
}

/// Which faces of a batch's triangles are surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Faces {
    /// The front; the back is solid but black.
    Front,
    /// The front. The back is another triangle in the same place: a double-sided surface in a bake.
    FrontOfTwins,
    /// Both faces of one triangle: a double-sided surface that was not baked.
    Both,
}

impl Faces {
    /// Returns true if backs are not drawn. The backs of single-sided surfaces are drawn black unless `cull_back` is
    /// set.
    #[must_use]
    pub fn are_culled(self, cull_back: bool) -> bool {
        match self {
            Faces::Front => cull_back,
            Faces::FrontOfTwins => true,
            Faces::Both => false,
        }
    }
}

/// Neighbouring triangles of one batch, which culling keeps or drops together.
#[derive(Clone, Debug)]
pub(super) struct Chunk {
    /// Index of the batch.
    pub batch: usize,
    /// Range of their indices in the index buffer.
    pub indices: Range<u32>,
    /// Box round them.
    pub bounds: Bounds,
}
