//! The scene that a subcommand works on: a file or a built-in scene.

use std::path::Path;

use anyhow::{Context, Result};
use clap::Args;

use crate::scene::gltf::LoadOptions;
use crate::scene::{Scene, builtin, gltf};

/// Which material variant of a file is used.
#[derive(Args, Clone, Debug)]
pub struct VariantOption {
    /// Material variant of the file, by name (KHR_materials_variants; `hemicube info` lists them) [default: the file's
    /// default materials].
    #[arg(long, value_name = "NAME")]
    pub variant: Option<String>,
}

/// Loads a scene: a file, or a built-in one as `builtin:NAME`.
///
/// # Errors
/// Returns an error if the file cannot be loaded or has no such variant, or if there is no such built-in scene.
pub fn load(path: &Path, options: &VariantOption) -> Result<Scene> {
    match path.to_str().and_then(|text| text.strip_prefix(builtin::PREFIX)) {
        Some(name) => builtin::by_name(name)
            .with_context(|| format!("there is no built-in scene {name}; there are {}", builtin::NAMES.join(", "))),
        None => Ok(gltf::load_with(path, &LoadOptions { variant: options.variant.clone() })?),
    }
}
