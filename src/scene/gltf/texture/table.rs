//! The textures that materials use, with their decoded images and samplers.
//!
//! An image that cannot be read is no error: it is replaced by a grey pixel, and a note for the user is added.

use std::collections::{BTreeMap, HashMap};

use gltf::json::texture::{MagFilter, WrappingMode};
use gltf::json::validation::Checked;
use gltf::json::{self, Index};
use rayon::prelude::*;

use super::image::{Encoded, fetch_images, or_stand_in};
use crate::base::ids::TextureId;
use crate::scene::gltf::error::Cause;
use crate::scene::gltf::file::document::Document;
use crate::scene::gltf::file::extension;
use crate::scene::{Sampler, Texture, Wrap};

/// Extensions that give a texture an image of another format, in order of preference.
const SOURCE_EXTENSIONS: [&str; 2] = ["KHR_texture_basisu", "EXT_texture_webp"];

/// Textures in the order in which materials first refer to them.
#[derive(Default)]
pub(crate) struct TextureTable {
    ids: HashMap<usize, TextureId>,
    in_file: Vec<usize>,
}

impl TextureTable {
    /// Returns the id of a texture of the file. `user` describes the material with the reference, for the error
    /// message.
    ///
    /// # Errors
    /// Returns an error if the texture does not exist.
    pub fn id(
        &mut self,
        document: &Document<'_>,
        index: Index<json::Texture>,
        user: impl Fn() -> String,
    ) -> Result<TextureId, Cause> {
        document.find(index, "texture", user)?;
        Ok(*self.ids.entry(index.value()).or_insert_with(|| {
            self.in_file.push(index.value());
            TextureId::new(self.in_file.len() - 1)
        }))
    }

    /// Loads the textures; every image is decoded once. Notes about missing images are added to `notes`.
    ///
    /// # Errors
    /// Returns an error if an image or a sampler does not exist.
    pub fn load(&self, document: &Document<'_>, notes: &mut Vec<String>) -> Result<Vec<Texture>, Cause> {
        let textures: Vec<_> = self.in_file.iter().map(|&i| (i, &document.root.textures[i])).collect();
        let mut sources = BTreeMap::new();
        for &(i, texture) in &textures {
            if let Some(source) = source_of(texture) {
                let image = Index::new(u32::try_from(source).unwrap_or(u32::MAX));
                sources.insert(source, document.find(image, "image", || format!("texture {i}"))?);
            }
        }
        let fetched = fetch_images(document, sources);
        let decoded: Vec<_> = fetched.into_par_iter().map(|(i, image)| (i, image.and_then(Encoded::decode))).collect();
        let images: HashMap<_, _> = decoded.into_iter().map(|(i, image)| (i, or_stand_in(image, notes))).collect();
        textures
            .into_iter()
            .map(|(i, texture)| {
                let image = source_of(texture).map(|source| images[&source].clone());
                let image = image.unwrap_or_else(|| or_stand_in(Err(sourceless(i, texture)), notes));
                Ok(Texture { image, sampler: sampler(document, i, texture)? })
            })
            .collect()
    }
}

/// Returns the index of the image of a texture: the image that the texture itself states, else that of an extension.
fn source_of(texture: &json::Texture) -> Option<usize> {
    // If a texture states no source, the typed model contains the largest index in its place.
    let plain = Some(texture.source.value()).filter(|&source| source != u32::MAX as usize);
    plain.or_else(|| {
        let extensions = &texture.extensions.as_ref()?.others;
        let source = SOURCE_EXTENSIONS.iter().find_map(|name| extensions.get(*name)?.get("source")?.as_u64());
        source.and_then(|source| usize::try_from(source).ok())
    })
}

fn sourceless(index: usize, texture: &json::Texture) -> String {
    match texture.extensions.iter().flat_map(|extensions| extensions.others.keys()).next() {
        Some(name) => {
            format!("texture {index} exists only as {}; {}", name.escape_debug(), extension::hint(name))
        }
        None => format!("texture {index} names no image"),
    }
}

fn sampler(document: &Document<'_>, index: usize, texture: &json::Texture) -> Result<Sampler, Cause> {
    let default = json::texture::Sampler::default();
    let sampler = match texture.sampler {
        Some(sampler) => document.find(sampler, "sampler", || format!("texture {index}"))?,
        None => &default,
    };
    Ok(Sampler {
        wrap_u: wrap(&sampler.wrap_s),
        wrap_v: wrap(&sampler.wrap_t),
        nearest: sampler.mag_filter == Some(Checked::Valid(MagFilter::Nearest)),
    })
}

fn wrap(mode: &Checked<WrappingMode>) -> Wrap {
    match mode {
        Checked::Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
        Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
        Checked::Valid(WrappingMode::Repeat) | Checked::Invalid => Wrap::Repeat,
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::Vec2;
    use serde_json::json;

    use super::*;
    use crate::scene::gltf::fixture::Fixture;

    #[test]
    fn an_image_keeps_its_pixels_and_its_encoded_bytes() {
        let mut fixture = Fixture::triangle();
        let texture = fixture.texture(&[[255, 0, 0, 255], [0, 0, 255, 128]]);
        fixture.json["samplers"] = json!([{"magFilter": 9728, "wrapS": 33071, "wrapT": 33648}]);
        fixture.json["textures"][texture]["sampler"] = json!(0);
        fixture.material(json!({"emissiveTexture": {"index": texture}}));
        let texture = &fixture.load().textures[0];
        assert_eq!((texture.image.width, texture.image.height), (2, 1));
        assert_eq!(texture.image.mime_type, "image/png");
        assert_eq!(texture.image.encoded[1..4], *b"PNG");
        assert_eq!(texture.sampler, Sampler { wrap_u: Wrap::Clamp, wrap_v: Wrap::Mirror, nearest: true });
        assert_eq!(texture.sample_linear(Vec2::new(0.9, 0.5)).to_array(), [0.0, 0.0, 1.0, 128.0 / 255.0]);
    }

    #[test]
    fn textures_share_the_image_that_they_refer_to() {
        let mut fixture = Fixture::triangle();
        fixture.texture(&[[9; 4]]);
        fixture.json["textures"] = json!([{"source": 0}, {"source": 0}]);
        let base = json!({"baseColorTexture": {"index": 1}});
        fixture.material(json!({"emissiveTexture": {"index": 0}, "pbrMetallicRoughness": base}));
        let scene = fixture.load();
        assert!(Arc::ptr_eq(&scene.textures[0].image, &scene.textures[1].image));
    }

    #[test]
    fn an_image_that_cannot_be_read_is_replaced_by_grey_with_a_note() {
        let images = [
            (json!({"uri": "no_such.png"}), "no folder"),
            (json!({"uri": "data:image/png;base64,AAAA"}), "neither PNG, JPEG, WebP nor KTX2"),
            (json!({"uri": "data:image/webp;base64,UklGRgQAAABXRUJQVlA4IAAA"}), "cannot be decoded"),
            (json!({"uri": "http://example.org/a.png"}), "refused"),
            (json!({}), "neither a URI nor a buffer view"),
            (json!({"bufferView": 99}), "buffer view 99, which does not exist"),
        ];
        for (image, expected) in images {
            let mut fixture = Fixture::triangle();
            fixture.json["images"] = json!([image]);
            fixture.json["textures"] = json!([{"source": 0}]);
            let info = json!({"index": 0});
            fixture.material(json!({"normalTexture": info, "pbrMetallicRoughness": {"baseColorTexture": info}}));
            let scene = fixture.load();
            assert!(scene.notes[0].contains(expected), "{:?} should contain {expected:?}", scene.notes);
            assert_eq!(scene.textures[0].image.rgba, [128, 128, 128, 255]);
            assert!(scene.materials[0].base_colour_texture.is_some() && scene.materials[0].normal_texture.is_none());
        }
    }

    #[test]
    fn a_texture_that_exists_only_as_an_extension_is_noted() {
        let mut fixture = Fixture::triangle();
        fixture.json["textures"] = json!([{"extensions": {"EXT_texture_avif": {"source": 0}}}]);
        fixture.material(json!({"emissiveTexture": {"index": 0}}));
        let notes = fixture.load().notes;
        assert!(notes[0].contains("EXT_texture_avif") && notes[0].contains("gltf-transform png"), "{notes:?}");
    }
}
