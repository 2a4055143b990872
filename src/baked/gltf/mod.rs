//! Writes a bake, or a plain scene, as a standard .glb, and takes the light of a bake back out of a loaded scene.
//!
//! Light is stored twice. For us, exactly, as float vertex attributes `_IRRADIANCE_DIRECT_g` and
//! `_IRRADIANCE_INDIRECT_g` (lux per channel, g counts the light groups), which other programs are bound to ignore. For
//! them, at one exposure, as vertex colours of unlit materials, which every viewer shows. What glTF has no words for lies
//! in `extras`: `light_groups` and `exposure_ev` of the glTF scene, `light_group` of lights and emissive materials,
//! `paint` of materials (what they were), `back_side` of primitives; vertex colours of the scene become `_COLOR` and
//! `_ALPHA`.
//! Programs that want light as a texture get a file of their own (`lightmap.rs`).
//!
//! Light comes back bit by bit, and so do meshes whose nodes are not turned; others within rounding, because each mesh is told
//! in the space of its node, where other programs unlit for it.
//! Deliberately absent: reading files, which is the loader's alone ([`crate::scene`]).
//!
//! Source: glTF 2.0 specification, sections 3 (concepts) and 4 (GLB file format).

mod binary;
mod hierarchy;
mod material;
mod mesh;
mod moz_lightmap;
mod node;
mod read;
mod unlit;

use std::collections::BTreeSet;
use std::path::Path;

use serde_json::{Map, Value, json};

use self::binary::Binary;
use self::unlit::UnlitAppearance;
use super::{BakedError, BakedScene, Lightmap};
use crate::base::output::write_whole;
use crate::scene::Scene;

pub use read::from_scene;

const GLB_MAGIC: u32 = 0x4654_6c67;
const CHUNK_JSON: u32 = 0x4e4f_534a;
const CHUNK_BINARY: u32 = 0x004e_4942;

/// Writes a bake to `path`: under a temporary name in the same folder, renamed when it is whole.
///
/// `exposure_ev` is the exposure at which other programs show it: displayed = radiance x 2^EV.
///
/// # Errors
/// The folder is not writable, or the scene is larger than a .glb can be.
pub fn write(path: &Path, baked: &BakedScene, exposure_ev: f32) -> Result<(), BakedError> {
    write_bytes(path, &to_glb(baked, exposure_ev)?)
}

/// Writes a scene with its light in a texture to `path`, as [`write()`] does.
///
/// `exposure_ev` is the exposure of all that shines in it: displayed = radiance x 2^EV.
///
/// # Errors
/// As [`write()`].
pub fn write_lightmap(path: &Path, lightmap: &Lightmap, exposure_ev: f32) -> Result<(), BakedError> {
    write_bytes(path, &lightmap_to_glb(lightmap, exposure_ev)?)
}

fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), BakedError> {
    write_whole(path, bytes).map_err(|source| BakedError::Write { path: path.to_owned(), source })
}

/// The bytes of a bake as .glb.
///
/// # Errors
/// The scene is larger than a .glb can be.
pub fn to_glb(baked: &BakedScene, exposure_ev: f32) -> Result<Vec<u8>, BakedError> {
    let unlit = UnlitAppearance { light: &baked.light, exposure: exposure_ev.exp2() };
    let mut document = Document::of(&baked.scene, LightOf::Vertices(unlit));
    document.root["scenes"][0]["extras"]["exposure_ev"] = json!(exposure_ev);
    document.into_glb()
}

/// The bytes of a scene with its light in a texture as .glb.
///
/// # Errors
/// The scene is larger than a .glb can be.
pub fn lightmap_to_glb(lightmap: &Lightmap, exposure_ev: f32) -> Result<Vec<u8>, BakedError> {
    let exposure = exposure_ev.exp2();
    let scene = moz_lightmap::shown(lightmap, exposure);
    let mut document = Document::of(&scene, LightOf::Texture { lightmap, exposure });
    let extras = &mut document.root["scenes"][0]["extras"];
    extras["exposure_ev"] = json!(exposure_ev);
    extras["lightmap_white_lux"] = json!(moz_lightmap::white(lightmap, exposure));
    document.into_glb()
}

/// The bytes of a scene without light as .glb.
///
/// # Errors
/// The scene is larger than a .glb can be.
pub fn scene_to_glb(scene: &Scene) -> Result<Vec<u8>, BakedError> {
    Document::of(scene, LightOf::Nothing).into_glb()
}

/// Where the light of a scene is told.
#[derive(Clone, Copy)]
enum LightOf<'a> {
    /// Nowhere.
    Nothing,
    /// At its vertices.
    Vertices(UnlitAppearance<'a>),
    /// In a texture; displayed = radiance x exposure.
    Texture { lightmap: &'a Lightmap, exposure: f32 },
}

/// Extensions that the written parts make use of.
type Extensions = BTreeSet<&'static str>;

/// The two halves of a .glb.
struct Document {
    root: Value,
    binary: Vec<u8>,
}

impl Document {
    /// Tells a scene in glTF's arrays; an empty array must not be written.
    fn of(scene: &Scene, light: LightOf<'_>) -> Self {
        let mut binary = Binary::default();
        let mut extensions = Extensions::new();
        let branches = hierarchy::branches(scene);
        let meshes = mesh::meshes(scene, &branches, light, &mut binary);
        let is_baked = matches!(light, LightOf::Vertices(_));
        let mut surfaces = material::surfaces(scene, is_baked, &mut binary, &mut extensions);
        if let LightOf::Texture { lightmap, exposure } = light {
            moz_lightmap::add(lightmap, exposure, scene, &mut surfaces, &mut binary, &mut extensions);
        }
        let mut root = Map::new();
        let mut put = |key: &str, items: Vec<Value>| {
            if !items.is_empty() {
                root.insert(key.to_owned(), Value::Array(items));
            }
        };
        put("images", surfaces.images);
        put("samplers", surfaces.samplers);
        put("textures", surfaces.textures);
        put("materials", surfaces.materials);
        put("cameras", node::cameras(scene));
        let (nodes, roots) = node::nodes(scene, &branches);
        put("nodes", nodes);
        put("meshes", meshes);
        let mut listed = Map::new();
        for (extension, lights) in [
            (node::LIGHTS_EXTENSION, node::lights(scene)),
            (node::PROFILES_EXTENSION, node::profiles(scene, &mut binary)),
        ] {
            if !lights.is_empty() {
                extensions.insert(extension);
                listed.insert(extension.into(), json!({ "lights": lights }));
            }
        }
        put("accessors", binary.accessors);
        put("bufferViews", binary.views);
        if !binary.bytes.is_empty() {
            put("buffers", vec![json!({ "byteLength": binary.bytes.len() })]);
        }
        if !listed.is_empty() {
            root.insert("extensions".into(), Value::Object(listed));
        }
        if !extensions.is_empty() {
            root.insert("extensionsUsed".into(), json!(extensions));
        }
        root.insert("asset".into(), json!({ "version": "2.0", "generator": "hemicube" }));
        root.insert("scene".into(), json!(0));
        root.insert("scenes".into(), json!([scene_object(scene, &roots)]));
        Self { root: Value::Object(root), binary: binary.bytes }
    }

    /// Packs the halves into one file: a header and two chunks, each padded to four bytes.
    fn into_glb(self) -> Result<Vec<u8>, BakedError> {
        let mut text = self.root.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut chunks = vec![(CHUNK_JSON, text)];
        if !self.binary.is_empty() {
            let mut bytes = self.binary;
            bytes.resize(bytes.len().next_multiple_of(4), 0);
            chunks.push((CHUNK_BINARY, bytes));
        }
        let total: usize = 12 + chunks.iter().map(|(_, bytes)| 8 + bytes.len()).sum::<usize>();
        let total = u32::try_from(total).map_err(|_| BakedError::TooLarge { bytes: total })?;
        let mut glb = Vec::with_capacity(total as usize);
        glb.extend([GLB_MAGIC, 2, total].into_iter().flat_map(u32::to_le_bytes));
        for (kind, bytes) in chunks {
            glb.extend([bytes.len() as u32, kind].into_iter().flat_map(u32::to_le_bytes));
            glb.extend(bytes);
        }
        Ok(glb)
    }
}

fn scene_object(scene: &Scene, roots: &[usize]) -> Value {
    let mut object = named(&scene.name);
    if !roots.is_empty() {
        object["nodes"] = json!(roots);
    }
    object["extras"] = json!({ "light_groups": scene.light_groups });
    object
}

/// An object with a name, or an empty one where the name is empty.
fn named(name: &str) -> Value {
    if name.is_empty() { json!({}) } else { json!({ "name": name }) }
}

#[cfg(test)]
mod tests;
