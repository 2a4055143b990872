//! A whole file: the JSON document with all parts of a scene, and the binary chunk.

use serde_json::{Map, Value, json};

use super::binary::Binary;
use super::json::{Extensions, named};
use super::light_storage::LightStorage;
use super::{hierarchy, material, mesh, moz_lightmap, node};
use crate::baked::BakedError;
use crate::scene::Scene;

const GLB_MAGIC: u32 = 0x4654_6c67;
const CHUNK_JSON: u32 = 0x4e4f_534a;
const CHUNK_BINARY: u32 = 0x004e_4942;

/// The two parts of a .glb.
pub(super) struct Document {
    pub(super) root: Value,
    binary: Vec<u8>,
}

impl Document {
    /// Builds the file of a scene with its light. Empty arrays are left out, because glTF forbids them.
    pub(super) fn of(scene: &Scene, light: LightStorage<'_>) -> Self {
        let mut binary = Binary::default();
        let mut extensions = Extensions::new();
        let branches = hierarchy::branches(scene);
        let meshes = mesh::meshes(scene, &branches, light, &mut binary);
        let is_baked = matches!(light, LightStorage::Vertices { .. });
        let mut surfaces = material::surfaces(scene, is_baked, &mut binary, &mut extensions);
        if let LightStorage::Texture { lightmap, exposure } = light {
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

    /// Packs the parts into one file: a header and two chunks, each padded to four bytes.
    pub(super) fn into_glb(self) -> Result<Vec<u8>, BakedError> {
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
