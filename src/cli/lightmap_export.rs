//! The light of a bake as a texture, in files beside the baked one.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use clap::Args;

use super::value::positive;
use crate::bake::{Bake, BakeSettings};
use crate::baked::{self, Lightmap};
use crate::base::output::write_whole;
use crate::lightmap::{LightmapSettings, lightmap};
use crate::scene::Scene;

/// Options of the lightmap.
#[derive(Args, Clone, Debug)]
pub struct LightmapOptions {
    /// Also writes the input scene with its light in a texture: OUT-lightmap.glb (second set of texture coordinates,
    /// MOZ_lightmap) and the texture in lux, OUT-lightmap.exr.
    #[arg(long)]
    pub lightmap: bool,
    /// Width of a texel on the surfaces, metres; enlarged if the texture would exceed 4096 x 4096 [default: 1/16 of the
    /// element size].
    #[arg(long, value_name = "M", value_parser = positive, requires = "lightmap")]
    pub texel_size: Option<f32>,
}

impl LightmapOptions {
    /// Computes the lightmap of a bake of `scene`; `None` without --lightmap.
    ///
    /// # Errors
    /// Returns an error if the scene falls into too many pieces.
    pub fn lightmap_of(&self, bake: &Bake, scene: &Scene, settings: &BakeSettings) -> Result<Option<Lightmap>> {
        if !self.lightmap {
            return Ok(None);
        }
        let preset = LightmapSettings::for_elements(settings.mesh_settings(scene).element_size);
        let settings = LightmapSettings { texel_size: self.texel_size.unwrap_or(preset.texel_size), ..preset };
        Ok(Some(lightmap(scene, &bake.mesh, &bake.baked.light, &settings)?))
    }
}

/// Writes a lightmap beside the baked scene. Returns a summary.
///
/// # Errors
/// Returns an error if a file cannot be written.
pub fn write_lightmap(map: &Lightmap, output: &Path, exposure_ev: f32) -> Result<String> {
    let [file, texture] = ["glb", "exr"].map(|extension| beside(output, extension));
    write_whole(&texture, &map.texels.to_exr()).with_context(|| format!("{}: cannot be written", texture.display()))?;
    baked::gltf::write_lightmap(&file, map, exposure_ev)?;
    Ok(format!(
        "{}: {} x {} texels of {:.1} mm, {:.2} % off the light at vertices in the mean",
        file.display(),
        map.texels.width,
        map.texels.height,
        1000.0 * map.texel_size,
        100.0 * map.deviation
    ))
}

/// Returns the path of a file of the lightmap beside the baked scene.
fn beside(output: &Path, extension: &str) -> PathBuf {
    let stem = output.file_stem().unwrap_or_default().to_string_lossy();
    output.with_file_name(format!("{stem}-lightmap.{extension}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_lie_beside_the_bake() {
        assert_eq!(beside(Path::new("out/my.house.glb"), "exr"), Path::new("out/my.house-lightmap.exr"));
    }
}
