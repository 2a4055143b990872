//! Errors of writing a bake.

use std::path::PathBuf;

use thiserror::Error;

/// Reason why a bake could not be written.
#[derive(Debug, Error)]
pub enum BakedError {
    /// The file system reported an error.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file to be written.
        path: PathBuf,
        /// Error of the file system.
        source: std::io::Error,
    },
    /// The file is too large: a .glb counts its bytes in 32 bits.
    #[error("the scene takes {bytes} bytes, a .glb file holds 4 GiB; bake with larger elements")]
    TooLarge {
        /// Size of the whole file.
        bytes: usize,
    },
}
