//! Textures: images in buffers, `data:` URIs or files, decoded in parallel, with their samplers.

mod decode;
mod image;
pub(super) mod table;
