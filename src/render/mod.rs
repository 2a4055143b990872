//! Floor 3: pictures of a lit scene, for the window and for files.
//!
//! The end of the route: a [`BakedScene`](crate::baked::BakedScene) is uploaded as
//! [`SceneBuffers`](crate::render::scene::SceneBuffers) and drawn by a [`Renderer`], whose [`frame`] reads as a recipe of passes;
//! each pass is a file here and a shader of the same stem. [`picture()`] does it all without a window.
//! Deliberately absent: a render graph, a scene tree, view-dependent light; light comes from the vertices.

pub mod compare;
pub mod develop;
pub mod false_colour;
pub mod flip;
pub mod frame;
pub mod light_tiles;
pub mod overlay;
pub mod picture;
pub mod scene;
mod settings;
pub mod shadow;
pub mod targets;
pub mod view;

mod frame_uniform;
mod meter;
mod surface;
mod surface_targets;
mod surface_variant;
mod tonemap;
mod weighted_light;

pub use compare::{Difference, Raster, compare, visible_difference};
pub use develop::develop;
pub use false_colour::{LuxScale, turbo};
pub use frame::Renderer;
pub use overlay::{Mark, Overlay, OverlayPass};
pub use picture::{FileKind, Picture, picture, picture_in_light, picture_of, save_display};
pub use settings::{Exposure, RenderSettings, Shading, ToneMap};
pub use shadow::{ShadowScene, ShadowSettings, ShadowTechnique};
pub use view::View;

use std::path::PathBuf;

use thiserror::Error;

/// A picture could not be read, written or compared.
#[derive(Debug, Error)]
pub enum RenderError {
    /// The file name does not say which format is meant.
    #[error("cannot tell the format of {path}: a picture ends in .png (as displayed) or .exr (linear radiance)")]
    UnknownExtension {
        /// The file as given.
        path: PathBuf,
    },
    /// The file system refused.
    #[error("cannot write {path}: {cause}")]
    Write {
        /// The file as given.
        path: PathBuf,
        /// What the system said.
        cause: std::io::Error,
    },
    /// The picture could not be encoded.
    #[error("cannot encode {path}: {cause}")]
    Encode {
        /// The file as given.
        path: PathBuf,
        /// What the encoder said.
        cause: image::ImageError,
    },
    /// A reference picture could not be read.
    #[error("cannot read the picture {path}: {cause}")]
    Read {
        /// The file as given.
        path: PathBuf,
        /// What the decoder said.
        cause: image::ImageError,
    },
    /// Pictures of different sizes have no difference.
    #[error("pictures of {}x{} and {}x{} pixels cannot be compared", a[0], a[1], b[0], b[1])]
    SizesDiffer {
        /// Size of the one, pixels.
        a: [u32; 2],
        /// Size of the other, pixels.
        b: [u32; 2],
    },
}
