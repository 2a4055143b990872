//! A parsed file with its buffers. [`Document::find`] checks indices before they are used. Skins (`mesh/skin.rs`) and
//! photometric profiles (`light/photometric.rs`) are untyped JSON; those two modules check their indices.

use std::borrow::Cow;
use std::path::Path;
use std::sync::OnceLock;

use gltf::json::buffer::View;
use gltf::json::root::Get;
use gltf::json::{Index, Root};
use serde_json::Value;

use super::container::{self, Parts};
use super::{meshopt, resource};
use crate::scene::gltf::error::Cause;

/// Largest number of bytes of all external buffers together. It is needed because many buffers may refer to the same
/// file.
const MAX_EXTERNAL_BYTES: u64 = 4 << 30;

/// Typed JSON and the bytes of its buffers.
pub(crate) struct Document<'a> {
    /// The JSON; its indices are not validated, so items are looked up through [`Document::find`].
    pub root: Root,
    /// Folder of external files; `None` if the file was given as bytes.
    pub folder: Option<&'a Path>,
    /// Skins as untyped JSON.
    pub skins: Vec<Value>,
    buffers: Vec<Result<Cow<'a, [u8]>, String>>,
    /// Decompressed buffer views `[view]`, each decompressed when it is first read.
    decompressed: Vec<OnceLock<Result<Vec<u8>, String>>>,
}

impl<'a> Document<'a> {
    /// Parses a file and reads its buffers. A buffer that cannot be read is an error only when it is used.
    ///
    /// # Errors
    /// Returns an error if the file is not glTF 2 or is cut off.
    pub fn parse(bytes: &'a [u8], folder: Option<&'a Path>) -> Result<Self, Cause> {
        let Parts { root, skins, blob } = container::split(bytes)?;
        let mut left = MAX_EXTERNAL_BYTES;
        let buffers = root.buffers.iter().enumerate().map(|(i, buffer)| match &buffer.uri {
            Some(uri) => resource::fetch(uri, folder, &mut left).map(Cow::Owned),
            None => blob.filter(|_| i == 0).map(Cow::Borrowed).ok_or_else(|| "it has no data".to_owned()),
        });
        let buffers = buffers.collect();
        let decompressed = root.buffer_views.iter().map(|_| OnceLock::new()).collect();
        Ok(Self { root, folder, skins, buffers, decompressed })
    }

    /// Returns the item at `index`. `user` describes the item with the reference, for the error message.
    ///
    /// # Errors
    /// Returns an error if no such item exists.
    pub fn find<T>(&self, index: Index<T>, kind: &'static str, user: impl Fn() -> String) -> Result<&T, Cause>
    where
        Root: Get<T>,
    {
        self.root.get(index).ok_or_else(|| Cause::DanglingIndex { user: user(), kind, index: index.value() })
    }

    /// Returns the bytes of a buffer view, and its stride if it states one.
    ///
    /// # Errors
    /// Returns an error if the view or its buffer does not exist, cannot be read or decompressed, or is too short.
    pub fn view(&self, index: Index<View>, user: impl Fn() -> String) -> Result<(&[u8], Option<usize>), Cause> {
        let view = self.find(index, "buffer view", user)?;
        let stride = view.byte_stride.map(|stride| stride.0).filter(|&stride| stride > 0);
        if let Some(extension) = meshopt::extension_of(view) {
            let decompress = || self.decompress(index, extension).map_err(|cause| cause.to_string());
            let decoded = self.decompressed[index.value()].get_or_init(decompress);
            let decoded = decoded.as_deref().map_err(|problem| Cause::Broken(problem.clone()))?;
            return Ok((decoded, stride));
        }
        let start = view.byte_offset.unwrap_or_default().0;
        Ok((self.slice(view.buffer, start, view.byte_length.0, index)?, stride))
    }

    fn decompress(&self, index: Index<View>, extension: &Value) -> Result<Vec<u8>, Cause> {
        let failed = |problem: String| Cause::Broken(format!("buffer view {index}: {problem}"));
        let stream = meshopt::Stream::parse(extension).map_err(failed)?;
        let bytes = self.slice(Index::new(stream.buffer), stream.byte_offset, stream.byte_length, index)?;
        stream.decode(bytes).map_err(failed)
    }

    /// Returns the range of a buffer to which `view` refers.
    fn slice(
        &self,
        buffer: Index<gltf::json::Buffer>,
        start: u64,
        length: u64,
        view: Index<View>,
    ) -> Result<&[u8], Cause> {
        let bytes = self.buffer(buffer, view)?;
        let end = start.checked_add(length);
        let range = usize::try_from(start).ok().zip(end.and_then(|end| usize::try_from(end).ok()));
        let slice = range.and_then(|(start, end)| bytes.get(start..end));
        slice.ok_or(Cause::BufferView { view: view.value(), buffer: buffer.value() })
    }

    fn buffer(&self, index: Index<gltf::json::Buffer>, view: Index<View>) -> Result<&[u8], Cause> {
        let promised = self.find(index, "buffer", || format!("buffer view {view}"))?.byte_length.0;
        let failed = |problem: String| Cause::Buffer { buffer: index.value(), problem };
        let bytes = self.buffers[index.value()].as_ref().map_err(|problem| failed(problem.clone()))?;
        if (bytes.len() as u64) < promised {
            return Err(failed(format!("it is cut off: {} of {promised} bytes are there", bytes.len())));
        }
        Ok(bytes)
    }
}
