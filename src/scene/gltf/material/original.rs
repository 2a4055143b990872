//! What a material of a bake was before it was made to show its light in every viewer.
//!
//! The writing side of this agreement is `baked/gltf/material.rs`.

use gltf::json;
use serde::Deserialize;

/// The `paint` of a material's `extras`.
#[derive(Debug, Default, Deserialize)]
pub(crate) struct OriginalMaterial {
    /// Base colour factor.
    pub base_colour: [f32; 4],
    /// Both faces reflect; the file has them as triangles of their own.
    pub double_sided: bool,
    /// It was unlit before.
    pub unlit: bool,
    /// The emissive texture stands in the place of the base colour's.
    #[serde(default)]
    pub shows_emission: bool,
    /// Base colour texture, where the emissive one took its place.
    #[serde(default)]
    pub base_colour_texture: Option<json::texture::Info>,
}

/// The paint under the light of a baked material; none for any other.
pub(crate) fn of(material: &json::Material) -> Option<OriginalMaterial> {
    let extras: serde_json::Value = serde_json::from_str(material.extras.as_ref()?.get()).ok()?;
    OriginalMaterial::deserialize(extras.get("paint")?).ok()
}
