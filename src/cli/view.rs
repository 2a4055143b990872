//! `hemicube [SCENE]`: the window.

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;

use super::bake_options::BakeOptions;
use super::scene_input::VariantOption;
#[cfg(feature = "viewer")]
use crate::viewer::{self, ViewerOptions};

/// Options of the viewer.
#[derive(Args, Debug)]
pub struct ViewArgs {
    /// Scene to open: .glb or .gltf, also a baked one (FILE#NAME chooses one of its scenes), or builtin:NAME
    /// [default: builtin:gallery].
    pub scene: Option<PathBuf>,
    /// Material variant of the file.
    #[command(flatten)]
    pub variant: VariantOption,
    /// How to bake a file that stores no light.
    #[command(flatten)]
    pub bake: BakeOptions,
    /// Reads shaders from the .wgsl files in a folder and again whenever one changes; an error is shown in the window
    /// while the last valid shaders stay in use [default in a debug build: shaders/ of the source tree].
    #[arg(long, value_name = "DIR")]
    pub shaders: Option<PathBuf>,
    /// Logs the time of each frame: seconds since it was requested, and 1 if a bake was running.
    #[arg(long, value_name = "FILE", hide = true)]
    pub frame_log: Option<PathBuf>,
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// Returns an error if there is no display, or no graphics device that can draw into a window.
#[cfg(feature = "viewer")]
pub fn run(args: &ViewArgs) -> Result<()> {
    let ViewArgs { scene, variant, bake, shaders, frame_log } = args;
    if let Some(folder) = shaders.as_ref().filter(|folder| !folder.is_dir()) {
        anyhow::bail!("there is no folder {}", folder.display());
    }
    viewer::run(ViewerOptions {
        scene: scene.clone(),
        variant: variant.variant.clone(),
        settings: bake.settings(),
        shaders: shaders.clone().or_else(source_folder),
        frame_log: frame_log.clone(),
    })
}

/// Explains how to build the program with the viewer.
///
/// # Errors
/// Always returns an error: this build has no viewer.
#[cfg(not(feature = "viewer"))]
pub fn run(_: &ViewArgs) -> Result<()> {
    anyhow::bail!("this build has no viewer: build it with the feature \"viewer\", or use a subcommand (see --help)")
}

/// Returns the folder of shaders in the source tree. `None` in a release build, or if the source tree does not exist.
#[cfg(feature = "viewer")]
fn source_folder() -> Option<PathBuf> {
    let folder = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders"));
    (cfg!(debug_assertions) && folder.is_dir()).then_some(folder)
}
