//! Settings and errors of a lightmap.

use thiserror::Error;

/// Resolution of a lightmap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightmapSettings {
    /// Width of a texel on the surfaces, metres. It is increased if the texture would otherwise exceed `max_side`.
    pub texel_size: f32,
    /// Largest width and height, texels.
    pub max_side: u32,
}

/// Texels along the longest edge of an element. Elements at the edges of shadows are up to 32 times shorter.
const TEXELS_AN_ELEMENT: f32 = 16.0;

/// Largest texture that every graphics card supports.
const MAX_SIDE: u32 = 4096;

impl LightmapSettings {
    /// Settings for a bake with this element size, metres.
    #[must_use]
    pub fn for_elements(element_size: f32) -> Self {
        Self { texel_size: element_size / TEXELS_AN_ELEMENT, max_side: MAX_SIDE }
    }
}

/// Reasons why a lightmap cannot be made.
#[derive(Debug, Error)]
pub enum LightmapError {
    /// The unwrapping failed.
    #[error("the scene cannot be laid flat: {0}")]
    Unwrap(#[from] uvunwrap::Error),
    /// The texture has no room for all pieces, even with large texels.
    #[error("a lightmap of {side} x {side} texels has no room for the {charts} pieces that the scene falls into")]
    TooManyCharts {
        /// Number of connected pieces of the unwrapped scene.
        charts: u32,
        /// Largest width and height, texels.
        side: u32,
    },
}
