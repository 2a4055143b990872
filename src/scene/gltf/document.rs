//! A parsed file with its buffers, and checked look-ups in it: no index of the file is used without one.

use std::borrow::Cow;
use std::path::Path;

use gltf::json::buffer::View;
use gltf::json::root::Get;
use gltf::json::{Index, Root};

use super::container;
use super::error::Cause;
use super::resource;

/// Typed JSON and the bytes it speaks of.
pub(super) struct Document<'a> {
    /// The JSON, not validated: look up through [`Document::find`].
    pub root: Root,
    /// Where external files lie.
    pub folder: Option<&'a Path>,
    buffers: Vec<Result<Cow<'a, [u8]>, String>>,
}

impl<'a> Document<'a> {
    /// Parses a file and fetches its buffers; a buffer that cannot be had is an error only when it is used.
    pub fn parse(bytes: &'a [u8], folder: Option<&'a Path>) -> Result<Self, Cause> {
        let (root, blob) = container::split(bytes)?;
        let buffers = root.buffers.iter().enumerate().map(|(i, buffer)| match &buffer.uri {
            Some(uri) => resource::fetch(uri, folder).map(Cow::Owned),
            None => blob.filter(|_| i == 0).map(Cow::Borrowed).ok_or_else(|| "it has no data".to_owned()),
        });
        let buffers = buffers.collect();
        Ok(Self { root, folder, buffers })
    }

    /// The item that `user` refers to.
    pub fn find<T>(&self, index: Index<T>, kind: &'static str, user: impl Fn() -> String) -> Result<&T, Cause>
    where
        Root: Get<T>,
    {
        self.root.get(index).ok_or_else(|| Cause::DanglingIndex { user: user(), kind, index: index.value() })
    }

    /// Bytes of a buffer view, and its stride where it gives one.
    pub fn view(&self, index: Index<View>, user: impl Fn() -> String) -> Result<(&[u8], Option<usize>), Cause> {
        let view = self.find(index, "buffer view", user)?;
        let buffer = view.buffer.value();
        let bytes = self.buffer(view.buffer, index)?;
        let start = view.byte_offset.unwrap_or_default().0;
        let end = start.checked_add(view.byte_length.0);
        let range = usize::try_from(start).ok().zip(end.and_then(|end| usize::try_from(end).ok()));
        let slice = range.and_then(|(start, end)| bytes.get(start..end));
        let slice = slice.ok_or(Cause::BufferView { view: index.value(), buffer })?;
        Ok((slice, view.byte_stride.map(|stride| stride.0).filter(|&stride| stride > 0)))
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
