//! The original material of a baked file.
//!
//! A baked file shows its light in every glTF viewer, so its materials are changed. `baked/gltf/material.rs` writes the
//! original values to `paint` in the material's `extras`; here they are read.

use gltf::json;
use serde::Deserialize;

/// The `paint` of a material's `extras`.
#[derive(Debug, Default, Deserialize)]
pub(crate) struct OriginalMaterial {
    /// Base colour factor.
    pub base_colour: [f32; 4],
    /// True if both faces reflect; the file then has separate triangles for the back faces.
    pub double_sided: bool,
    /// True if the original material is unlit.
    pub unlit: bool,
    /// True if the file has the emissive texture in place of the base colour texture.
    #[serde(default)]
    pub shows_emission: bool,
    /// Original base colour texture, if the emissive texture takes its place in the file.
    #[serde(default)]
    pub base_colour_texture: Option<json::texture::Info>,
}

/// Returns the original of a baked material; `None` for a material that no bake has changed.
pub(crate) fn of(material: &json::Material) -> Option<OriginalMaterial> {
    let extras: serde_json::Value = serde_json::from_str(material.extras.as_ref()?.get()).ok()?;
    OriginalMaterial::deserialize(extras.get("paint")?).ok()
}
