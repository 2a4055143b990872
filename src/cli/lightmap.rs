//! The light of a bake as a texture, in files beside the baked one.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use clap::Args;

use super::bake_options::positive;
use crate::bake::{Bake, BakeSettings};
use crate::baked;
use crate::base::output::write_whole;
use crate::lightmap::{LightmapSettings, lightmap};
use crate::scene::Scene;

/// Whether and how light is written as a texture.
#[derive(Args, Clone, Debug)]
pub struct LightmapOptions {
    /// Also writes the scene as it was, not cut into elements, with its light in a texture: OUT-lightmap.glb (second set of
    /// texture coordinates, MOZ_lightmap) and the texture in lux, OUT-lightmap.exr.
    #[arg(long)]
    pub lightmap: bool,
    /// Width of a texel on the surfaces in metres; larger where the texture would exceed 4096 x 4096 [default: a 16th of the
    /// element size].
    #[arg(long, value_name = "M", value_parser = positive, requires = "lightmap")]
    pub texel_size: Option<f32>,
}

impl LightmapOptions {
    /// Makes and writes the lightmap of a bake of `scene`, where one is wanted.
    ///
    /// # Errors
    /// The scene falls into too many pieces, or a file cannot be written.
    pub fn write(
        &self,
        bake: &Bake,
        scene: &Scene,
        settings: &BakeSettings,
        output: &Path,
        exposure_ev: f32,
    ) -> Result<Option<String>> {
        if !self.lightmap {
            return Ok(None);
        }
        let suited = LightmapSettings::for_elements(settings.mesh_settings(scene).element_size);
        let wanted = LightmapSettings { texel_size: self.texel_size.unwrap_or(suited.texel_size), ..suited };
        let map = lightmap(scene, &bake.mesh, &bake.baked.light, &wanted)
            .with_context(|| format!("{}: no lightmap", output.display()))?;
        let [file, texture] = ["glb", "exr"].map(|ending| beside(output, ending));
        write_whole(&texture, &map.texels.to_exr())
            .with_context(|| format!("{}: cannot be written", texture.display()))?;
        baked::gltf::write_lightmap(&file, &map, exposure_ev)?;
        Ok(Some(format!(
            "{}: {} x {} texels of {:.1} mm, {:.2} % off the light at vertices in the mean",
            file.display(),
            map.texels.width,
            map.texels.height,
            1000.0 * map.texel_size,
            100.0 * map.deviation
        )))
    }
}

/// The lightmap's file beside the baked one.
fn beside(output: &Path, ending: &str) -> PathBuf {
    let stem = output.file_stem().unwrap_or_default().to_string_lossy();
    output.with_file_name(format!("{stem}-lightmap.{ending}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_lie_beside_the_bake() {
        assert_eq!(beside(Path::new("out/my.house.glb"), "exr"), Path::new("out/my.house-lightmap.exr"));
    }
}
