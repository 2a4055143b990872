//! Where the light of a scene is stored in a file.

use super::unlit::UnlitAppearance;
use crate::baked::{BisectionTrees, Lightmap};

/// Where the light of a scene is stored.
#[derive(Clone, Copy)]
pub(super) enum LightStorage<'a> {
    /// There is no light.
    None,
    /// At the vertices of elements, with the bisection trees of the elements if they are known.
    Vertices { appearance: UnlitAppearance<'a>, trees: Option<&'a BisectionTrees> },
    /// In a texture; displayed = radiance x exposure.
    Texture { lightmap: &'a Lightmap, exposure: f32 },
}
