//! Images: their encoded bytes from buffers, `data:` URIs or files, and their decoded pixels.

use std::collections::BTreeMap;
use std::sync::Arc;

use gltf::json;

use super::decode::{self, Pixels};
use crate::scene::Image;
use crate::scene::gltf::file::document::Document;
use crate::scene::gltf::file::resource;

/// Largest number of bytes of all encoded images together.
const MAX_ENCODED_BYTES: u64 = 4 << 30;

/// Largest number of pixels of all images together; 4 GiB as RGBA.
const MAX_PIXELS: u64 = 1 << 30;

/// An image before it is decoded.
pub(crate) struct Encoded {
    name: String,
    bytes: Vec<u8>,
}

impl Encoded {
    fn failed(name: &str, problem: &str) -> String {
        format!("texture image {name:?}: {problem}")
    }

    pub(crate) fn decode(self) -> Result<Image, String> {
        let Self { name, bytes: encoded } = self;
        let decoded = decode::decode(&encoded).map_err(|problem| Self::failed(&name, &problem))?;
        let Pixels { width, height, rgba, mime_type } = decoded;
        Ok(Image { width, height, rgba, mime_type: mime_type.to_owned(), encoded, name })
    }
}

/// Fetches all encoded images `[image]`. The result for an image is an error if the image cannot be read, or if its
/// header states more pixels than the limit allows.
pub(crate) fn fetch_images(
    document: &Document<'_>,
    sources: BTreeMap<usize, &json::Image>,
) -> Vec<(usize, Result<Encoded, String>)> {
    let (mut bytes_left, mut pixels_left) = (MAX_ENCODED_BYTES, MAX_PIXELS);
    let fetch = |(index, image): (usize, &json::Image)| {
        let uri = image.uri.as_deref().filter(|uri| !uri.starts_with("data:"));
        let name = image.name.as_deref().or(uri).map_or_else(|| format!("image {index}"), str::to_owned);
        let fetched = encoded_bytes(document, index, image, &mut bytes_left).and_then(|bytes| {
            let claimed = decode::claimed_pixels(&bytes)?;
            pixels_left = pixels_left.checked_sub(claimed).ok_or("all images together are too large")?;
            Ok(bytes)
        });
        let named = |problem: String| Encoded::failed(&name, &problem);
        (index, fetched.map_err(named).map(|bytes| Encoded { name: name.clone(), bytes }))
    };
    sources.into_iter().map(fetch).collect()
}

fn encoded_bytes(
    document: &Document<'_>,
    index: usize,
    image: &json::Image,
    bytes_left: &mut u64,
) -> Result<Vec<u8>, String> {
    match (&image.uri, image.buffer_view) {
        (Some(uri), _) => resource::fetch(uri, document.folder, bytes_left),
        (None, Some(view)) => {
            let view = document.view(view, || format!("image {index}"));
            view.map(|(bytes, _)| bytes.to_vec()).map_err(|cause| cause.to_string())
        }
        (None, None) => Err("it has neither a URI nor a buffer view".to_owned()),
    }
}

pub(crate) fn or_stand_in(image: Result<Image, String>, notes: &mut Vec<String>) -> Arc<Image> {
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
