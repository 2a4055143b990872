//! Light in a texture for other programs: `MOZ_lightmap` on the materials.
//!
//! Equation: shown = base colour x texel x intensity / pi, as in three.js and Hubs; a texel is irradiance. The image
//! has eight bits per channel and is linear, as the extension requires. Its white is the brightest irradiance, but at
//! most the irradiance that shows white paint at twice the display white. Light and emission are scaled by one
//! exposure. Lights are left out, because the texture contains their light.
//!
//! Source: GLTFLightMapLoaderExtension of three.js r188; Hubs, pull request 2375.

use std::f32::consts::{PI, TAU};

use glam::Vec3;
use image::ExtendedColorType;
use serde_json::{Value, json};

use super::binary::Binary;
use super::json::Extensions;
use super::material::{Surfaces, png, texture_slots};
use crate::baked::Lightmap;
use crate::base::sampling::r2;
use crate::scene::{Material, Scene};

const EXTENSION: &str = "MOZ_lightmap";

/// Returns the texture coordinate set of the lightmap: the second, or a later one if the material uses that.
pub(super) fn uv_set(material: &Material) -> usize {
    texture_slots(material).map(|slot| slot.uv_set + 1).max().unwrap_or(0).max(1)
}

/// Returns the irradiance of a white texel, lux.
pub(super) fn white(lightmap: &Lightmap, exposure: f32) -> f32 {
    let brightest = lightmap.texels.irradiance.iter().map(|light| light.max_element()).fold(0.0, f32::max);
    if brightest > 0.0 { brightest.min(TAU / exposure) } else { PI / exposure }
}

/// Returns the scene at an exposure: emission is scaled, there are no lights, and no material is double-sided, because
/// backs are separate triangles.
pub(super) fn shown(lightmap: &Lightmap, exposure: f32) -> Scene {
    let mut scene = lightmap.scene.clone();
    scene.lights.clear();
    scene.nodes.iter_mut().for_each(|node| node.light = None);
    for material in &mut scene.materials {
        material.double_sided = false;
        material.emission *= exposure;
        if material.unlit {
            let alpha = material.base_colour.w;
            material.base_colour = (material.base_colour.truncate() * exposure).min(Vec3::ONE).extend(alpha);
        }
    }
    scene
}

/// Adds the image, and a reference to it to every lit material.
pub(super) fn add(
    lightmap: &Lightmap,
    exposure: f32,
    scene: &Scene,
    surfaces: &mut Surfaces,
    binary: &mut Binary,
    used: &mut Extensions,
) {
    let white = white(lightmap, exposure);
    let picture = binary.push_file(&picture(lightmap, white));
    surfaces.images.push(json!({ "name": "lightmap", "bufferView": picture, "mimeType": "image/png" }));
    surfaces.samplers.push(sampler());
    let (source, sampler) = (surfaces.images.len() - 1, surfaces.samplers.len() - 1);
    surfaces.textures.push(json!({ "source": source, "sampler": sampler }));
    let index = surfaces.textures.len() - 1;
    let lit = scene.materials.iter().zip(&mut surfaces.materials).filter(|(material, _)| !material.unlit);
    for (material, object) in lit {
        object["extensions"][EXTENSION] =
            json!({ "index": index, "texCoord": uv_set(material), "intensity": white * exposure });
        used.insert(EXTENSION);
    }
}

/// Returns a sampler without mip maps, which would mix charts that are neighbours only in the image.
fn sampler() -> Value {
    const LINEAR: u32 = 9729;
    const CLAMP: u32 = 33071;
    json!({ "wrapS": CLAMP, "wrapT": CLAMP, "magFilter": LINEAR, "minFilter": LINEAR })
}

/// Returns the image, dithered by a fixed pattern, so that dark gradients show no bands.
fn picture(lightmap: &Lightmap, white: f32) -> Vec<u8> {
    let texels = &lightmap.texels;
    let bytes: Vec<u8> = texels
        .irradiance
        .iter()
        .enumerate()
        .flat_map(|(texel, &light)| {
            let threshold = threshold(texel as u32 % texels.width, texel as u32 / texels.width);
            (255.0 * light / white).to_array().map(|channel| (channel + threshold).clamp(0.0, 255.0) as u8)
        })
        .collect();
    png(&bytes, texels.width, texels.height, ExtendedColorType::Rgb8)
}

/// Returns the threshold of dithering, evenly distributed in 0..1 in every neighbourhood (Roberts 2018, as [`r2`]).
fn threshold(x: u32, y: u32) -> f32 {
    (r2(x, 0).x + r2(y, 0).y).fract()
}
