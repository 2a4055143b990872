//! The light of a picture: whether it is stored or baked now, and which parts of it are shown.

use anyhow::Result;
use glam::Vec3;

use super::options::{Lighting, RenderArgs};
use crate::baked::{self, BakedScene, VertexLight};
use crate::cli::lit_scene::{bake_device, lit_scene};
use crate::cli::terminal::Terminal;
use crate::gpu::Gpu;
use crate::render::RenderSettings;
use crate::scene::Scene;

/// Returns the scene with the light of a rasterised picture: stored in the file, or baked now if the picture shows
/// baked light.
///
/// # Errors
/// Returns an error if the scene cannot be baked.
pub fn raster_light(gpu: &Gpu, scene: Scene, args: &RenderArgs, terminal: Terminal) -> Result<BakedScene> {
    let needs_no_bake = match args.lighting() {
        Lighting::Ambient => true,
        Lighting::Direct => args.shadows.shadows.is_some(),
        Lighting::Radiosity | Lighting::IndirectAndDirect => false,
    };
    if needs_no_bake { Ok(stored_light(scene)) } else { lit_scene(Some(gpu), scene, &args.bake.settings(), terminal) }
}

/// Returns the scene with the light of the first pass, from which the second pass takes indirect light. Bakes it unless
/// the file stores it or the picture shows none.
///
/// # Errors
/// Returns an error if the scene cannot be baked.
pub fn first_pass_light(scene: Scene, args: &RenderArgs, terminal: Terminal) -> Result<BakedScene> {
    match (baked::gltf::from_scene(scene), args.lighting()) {
        (Ok(baked), _) => Ok(baked),
        (Err(scene), Lighting::Direct | Lighting::Ambient) => Ok(BakedScene::dark(scene)),
        (Err(scene), _) => {
            let settings = args.bake.settings();
            lit_scene(bake_device(&settings)?.as_ref(), scene, &settings, terminal)
        }
    }
}

/// Returns the scene with the light that its file stores, or without light if it stores none.
pub fn stored_light(scene: Scene) -> BakedScene {
    baked::gltf::from_scene(scene).unwrap_or_else(BakedScene::dark)
}

/// Returns render settings for the light that the options choose.
pub fn render_settings(args: &RenderArgs, baked: &BakedScene) -> RenderSettings {
    let all = RenderSettings {
        exposure: args.exposure,
        shadows: args.shadows.settings(),
        shadow_debug: args.shadows.debug(),
        ..RenderSettings::default()
    };
    // Under `Ambient` a constant term replaces the stored light. Direct light is shown only if it is computed in real
    // time, with shadows.
    let shadowed = f32::from(u8::from(all.shadows.is_some()));
    match args.lighting() {
        Lighting::Direct => RenderSettings { indirect: 0.0, ..all },
        Lighting::Ambient => {
            RenderSettings { direct: shadowed, indirect: 0.0, ambient: mean_radiance(&baked.light), ..all }
        }
        Lighting::Radiosity | Lighting::IndirectAndDirect => all,
    }
}

/// Computes the radiance of white paint under the mean irradiance of the vertices, L = E / pi; 1 if there is no light.
fn mean_radiance(light: &VertexLight) -> Vec3 {
    let num_vertices = light.groups.first().map_or(0, |group| group.direct.len()).max(1);
    let total: Vec3 = light.groups.iter().flat_map(|group| group.direct.iter().chain(&group.indirect)).sum();
    if total == Vec3::ZERO { Vec3::ONE } else { total / (num_vertices as f32 * std::f32::consts::PI) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ambient_light_is_as_strong_as_the_mean() {
        let mut light = VertexLight::dark(2, 4);
        assert_eq!(mean_radiance(&light), Vec3::ONE);
        light.groups[1].indirect[2] = Vec3::splat(4.0 * std::f32::consts::PI);
        assert!((mean_radiance(&light) - Vec3::ONE).abs().max_element() < 1e-6);
    }
}
