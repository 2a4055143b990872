//! Textures: images of buffers, data: URIs or files, decoded in parallel, with their samplers.
//!
//! An image that cannot be had is never fatal: a grey pixel stands in and a note says so.

use std::collections::{BTreeMap, HashMap};
use std::io::Cursor;
use std::sync::Arc;

use gltf::json::texture::{MagFilter, WrappingMode};
use gltf::json::validation::Checked;
use gltf::json::{self, Index};
use image::{ImageFormat, ImageReader, Limits};
use rayon::prelude::*;

use super::document::Document;
use super::error::Cause;
use super::{extension, resource};
use crate::base::ids::TextureId;
use crate::scene::{Image, Sampler, Texture, Wrap};

/// Largest image side that is decoded, pixels.
const MAX_IMAGE_SIDE: u32 = 16_384;

/// Textures in the order in which materials first asked for them.
#[derive(Default)]
pub(super) struct TextureTable {
    ids: HashMap<usize, TextureId>,
    in_file: Vec<usize>,
}

impl TextureTable {
    /// Id of a texture of the file, whose existence is checked here.
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

    /// Decodes every image that was asked for, once each.
    pub fn load(&self, document: &Document<'_>, notes: &mut Vec<String>) -> Result<Vec<Texture>, Cause> {
        let textures: Vec<_> = self.in_file.iter().map(|&i| (i, &document.root.textures[i])).collect();
        let mut sources = BTreeMap::new();
        for &(i, texture) in &textures {
            if let Some(source) = source_of(texture) {
                sources.insert(source, document.find(texture.source, "image", || format!("texture {i}"))?);
            }
        }
        let sources: Vec<_> = sources.into_iter().collect();
        let decoded: Vec<_> = sources.par_iter().map(|&(i, image)| (i, read_image(document, i, image))).collect();
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

/// Index of the PNG or JPEG image of a texture; the typed model has a sentinel for none.
fn source_of(texture: &json::Texture) -> Option<usize> {
    Some(texture.source.value()).filter(|&source| source != u32::MAX as usize)
}

fn sourceless(index: usize, texture: &json::Texture) -> String {
    match texture.extensions.iter().flat_map(|extensions| extensions.others.keys()).next() {
        Some(name) => {
            format!("texture {index} exists only as {}; {}", name.escape_debug(), extension::hint(name))
        }
        None => format!("texture {index} names no image"),
    }
}

fn or_stand_in(image: Result<Image, String>, notes: &mut Vec<String>) -> Arc<Image> {
    Arc::new(image.unwrap_or_else(|problem| {
        notes.push(format!("{problem}; grey is used instead"));
        Image {
            name: "missing".to_owned(),
            width: 1,
            height: 1,
            rgba: vec![128, 128, 128, 255],
            encoded: Vec::new(),
            mime_type: String::new(),
        }
    }))
}

fn read_image(document: &Document<'_>, index: usize, image: &json::Image) -> Result<Image, String> {
    let uri = image.uri.as_deref().filter(|uri| !uri.starts_with("data:"));
    let name = image.name.as_deref().or(uri).map_or_else(|| format!("image {index}"), str::to_owned);
    let failed = |problem: String| format!("texture image {name:?}: {problem}");
    let encoded = encoded_bytes(document, index, image).map_err(failed)?;
    let (format, pixels) = decode(&encoded).map_err(failed)?;
    Ok(Image {
        width: pixels.width(),
        height: pixels.height(),
        rgba: pixels.into_raw(),
        mime_type: format.to_mime_type().to_owned(),
        encoded,
        name,
    })
}

fn encoded_bytes(document: &Document<'_>, index: usize, image: &json::Image) -> Result<Vec<u8>, String> {
    match (&image.uri, image.buffer_view) {
        (Some(uri), _) => resource::fetch(uri, document.folder),
        (None, Some(view)) => {
            let view = document.view(view, || format!("image {index}"));
            view.map(|(bytes, _)| bytes.to_vec()).map_err(|cause| cause.to_string())
        }
        (None, None) => Err("it has neither a URI nor a buffer view".to_owned()),
    }
}

fn decode(encoded: &[u8]) -> Result<(ImageFormat, image::RgbaImage), String> {
    let format = match image::guess_format(encoded) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg)) => format,
        Ok(ImageFormat::WebP) => return Err(format!("WebP is not supported; {}", extension::hint("EXT_texture_webp"))),
        _ => return Err("it is neither PNG nor JPEG".to_owned()),
    };
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_IMAGE_SIDE);
    limits.max_image_height = Some(MAX_IMAGE_SIDE);
    let mut reader = ImageReader::with_format(Cursor::new(encoded), format);
    reader.limits(limits);
    let pixels = reader.decode().map_err(|error| format!("it cannot be decoded: {error}"))?;
    Ok((format, pixels.into_rgba8()))
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
