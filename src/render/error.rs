//! Errors of pictures and their files.

use std::path::PathBuf;

use thiserror::Error;

/// A picture could not be read, written or compared.
#[derive(Debug, Error)]
pub enum RenderError {
    /// The file name ends in no known extension.
    #[error("cannot tell the format of {path}: a picture ends in .png (as displayed) or .exr (linear radiance)")]
    UnknownExtension {
        /// The file as given.
        path: PathBuf,
    },
    /// The file system reported an error while the file was written.
    #[error("cannot write {path}: {cause}")]
    Write {
        /// The file as given.
        path: PathBuf,
        /// The message of the system.
        cause: std::io::Error,
    },
    /// The picture could not be encoded.
    #[error("cannot encode {path}: {cause}")]
    Encode {
        /// The file as given.
        path: PathBuf,
        /// The message of the encoder.
        cause: image::ImageError,
    },
    /// A reference picture could not be read.
    #[error("cannot read the picture {path}: {cause}")]
    Read {
        /// The file as given.
        path: PathBuf,
        /// The message of the decoder.
        cause: image::ImageError,
    },
    /// Pictures of different sizes cannot be compared.
    #[error("pictures of {}x{} and {}x{} pixels cannot be compared", a[0], a[1], b[0], b[1])]
    SizesDiffer {
        /// Size of the first, pixels.
        a: [u32; 2],
        /// Size of the second, pixels.
        b: [u32; 2],
    },
}
