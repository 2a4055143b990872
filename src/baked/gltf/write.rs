//! Writes scenes, bakes and lightmaps as bytes and files.

use std::path::Path;

use serde_json::json;

use super::document::Document;
use super::light_storage::LightStorage;
use super::moz_lightmap;
use super::unlit::UnlitAppearance;
use crate::baked::{BakedError, BakedScene, Lightmap};
use crate::base::output::write_whole;
use crate::scene::Scene;

/// Writes a bake to `path`. The file has a temporary name in the same folder until it is complete.
///
/// `exposure_ev` is the exposure at which other programs show the bake: displayed = radiance x 2^EV.
///
/// # Errors
/// Returns an error if the folder is not writable or the scene is larger than a .glb can be.
pub fn write(path: &Path, baked: &BakedScene, exposure_ev: f32) -> Result<(), BakedError> {
    write_bytes(path, &to_glb(baked, exposure_ev)?)
}

/// Writes a scene with its light in a texture to `path`, as [`write()`] does.
///
/// `exposure_ev` is the exposure of light and emission in the file: displayed = radiance x 2^EV.
///
/// # Errors
/// Returns an error as [`write()`] does.
pub fn write_lightmap(path: &Path, lightmap: &Lightmap, exposure_ev: f32) -> Result<(), BakedError> {
    write_bytes(path, &lightmap_to_glb(lightmap, exposure_ev)?)
}

fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), BakedError> {
    write_whole(path, bytes).map_err(|source| BakedError::Write { path: path.to_owned(), source })
}

/// Returns the bytes of a bake as .glb.
///
/// # Errors
/// Returns an error if the scene is larger than a .glb can be.
pub fn to_glb(baked: &BakedScene, exposure_ev: f32) -> Result<Vec<u8>, BakedError> {
    let appearance = UnlitAppearance { light: &baked.light, exposure: exposure_ev.exp2() };
    let mut document = Document::of(&baked.scene, LightStorage::Vertices { appearance, trees: baked.trees.as_ref() });
    document.root["scenes"][0]["extras"]["exposure_ev"] = json!(exposure_ev);
    document.into_glb()
}

/// Returns the bytes of a scene with its light in a texture as .glb.
///
/// # Errors
/// Returns an error if the scene is larger than a .glb can be.
pub fn lightmap_to_glb(lightmap: &Lightmap, exposure_ev: f32) -> Result<Vec<u8>, BakedError> {
    let exposure = exposure_ev.exp2();
    let scene = moz_lightmap::shown(lightmap, exposure);
    let mut document = Document::of(&scene, LightStorage::Texture { lightmap, exposure });
    let extras = &mut document.root["scenes"][0]["extras"];
    extras["exposure_ev"] = json!(exposure_ev);
    extras["lightmap_white_lux"] = json!(moz_lightmap::white(lightmap, exposure));
    document.into_glb()
}

/// Returns the bytes of a scene without light as .glb.
///
/// # Errors
/// Returns an error if the scene is larger than a .glb can be.
pub fn scene_to_glb(scene: &Scene) -> Result<Vec<u8>, BakedError> {
    Document::of(scene, LightStorage::None).into_glb()
}
