//! What is drawn in one call, and the chunks that culling selects from it.

use std::ops::Range;

use crate::base::bounds::Bounds;
use crate::base::ids::MaterialId;
use crate::scene::AlphaMode;

/// Triangles that are drawn in one call.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawBatch {
    /// Their part of the index buffer.
    pub indices: Range<u32>,
    /// Their material.
    pub material: MaterialId,
    /// How its alpha acts.
    pub alpha_mode: AlphaMode,
    /// Which faces exist.
    pub faces: Faces,
    /// Its material has textures.
    pub has_textures: bool,
    /// Its material shows its base colour as it is, without light (`KHR_materials_unlit`).
    pub is_unlit: bool,
    /// Its light is in tiles, not at its vertices.
    pub is_tiled: bool,
}

/// Which faces of a batch's triangles are surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Faces {
    /// The front; the back is solid but black.
    Front,
    /// The front, and another triangle in the same place is the back: a double-sided surface in a bake.
    FrontOfTwins,
    /// Both faces of one triangle: a double-sided surface that was not baked.
    Both,
}

impl Faces {
    /// Nothing is drawn of the back. Single-sided surfaces are invisible from behind if `cull_back` is set.
    #[must_use]
    pub fn are_culled(self, cull_back: bool) -> bool {
        match self {
            Faces::Front => cull_back,
            Faces::FrontOfTwins => true,
            Faces::Both => false,
        }
    }
}

/// Neighbouring triangles of one batch, which culling keeps or drops as one.
#[derive(Clone, Debug)]
pub(super) struct Chunk {
    /// Index of the batch.
    pub batch: usize,
    /// Their part of the index buffer.
    pub indices: Range<u32>,
    /// Box round them.
    pub bounds: Bounds,
}
