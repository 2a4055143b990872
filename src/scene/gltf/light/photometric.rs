//! EXT_lights_ies: lights with the intensity distribution of a photometric file.
//!
//! Source: the extension's specification; type C photometry only.

use std::collections::HashMap;
use std::sync::Arc;

use glam::{DAffine3, DQuat, Vec3};
use gltf::json::{Index, Node, Root};
use serde::Deserialize;
use serde_json::Value;

use super::punctual::MAX_INTENSITY;
use crate::scene::Light;
use crate::scene::gltf::error::Cause;
use crate::scene::gltf::file::document::Document;
use crate::scene::gltf::file::resource;
use crate::scene::gltf::node::tree::frame;
use crate::scene::photometry::{self, Photometry, Profile};

/// Name of the extension.
pub(crate) const EXTENSION: &str = "EXT_lights_ies";

/// Largest photometric file, bytes.
const MAX_BYTES: u64 = 16 << 20;

/// JSON of a photometric file in the root of the document.
#[derive(Deserialize)]
struct Definition {
    uri: Option<String>,
    #[serde(rename = "bufferView")]
    buffer_view: Option<u32>,
}

/// JSON of a node's light.
#[derive(Deserialize)]
pub(crate) struct NodeLight {
    /// Index of the photometric file.
    pub light: usize,
    #[serde(default = "one")]
    multiplier: f32,
    #[serde(default = "white")]
    color: [f32; 3],
}

fn one() -> f32 {
    1.0
}

fn white() -> [f32; 3] {
    [1.0; 3]
}

/// The photometric files of a glTF file, each read once.
pub(crate) struct Profiles<'a> {
    document: &'a Document<'a>,
    read: HashMap<usize, Result<Arc<Photometry>, String>>,
}

/// Returns the photometric light of a node; `None` if the node has none.
///
/// # Errors
/// Returns an error if the extension is invalid.
pub(crate) fn of_node(node: &Node, index: usize) -> Result<Option<NodeLight>, Cause> {
    let extension = node.extensions.as_ref().and_then(|extensions| extensions.others.get(EXTENSION));
    let parsed = extension.map(NodeLight::deserialize).transpose();
    parsed.map_err(|error| Cause::Broken(format!("node {index}: {EXTENSION}: {error}")))
}

/// Returns the JSON of the document's photometric files.
pub(crate) fn definitions(root: &Root) -> &[Value] {
    let extension = root.extensions.as_ref().and_then(|extensions| extensions.others.get(EXTENSION));
    extension.and_then(|extension| extension["lights"].as_array()).map_or(&[], Vec::as_slice)
}

impl NodeLight {
    /// Returns the factor of the photometric intensities: colour times multiplier, per channel.
    pub fn factor(&self) -> Vec3 {
        (Vec3::from(self.color).clamp(Vec3::ZERO, Vec3::ONE) * self.multiplier).max(Vec3::ZERO)
    }
}

impl<'a> Profiles<'a> {
    pub fn new(document: &'a Document<'a>) -> Self {
        Self { document, read: HashMap::new() }
    }

    /// Returns the distribution in photometric file `index`.
    ///
    /// # Errors
    /// Returns an error if the file cannot be read. The error is one sentence that the caller embeds in a note.
    pub fn get(&mut self, index: usize) -> Result<Arc<Photometry>, String> {
        let document = self.document;
        let read = || read(document, definitions(&document.root).get(index).ok_or("the file has no such profile")?);
        self.read.entry(index).or_insert_with(read).clone()
    }
}

fn read(document: &Document<'_>, definition: &Value) -> Result<Arc<Photometry>, String> {
    let definition = Definition::deserialize(definition).map_err(|error| error.to_string())?;
    let table = match (definition.uri, definition.buffer_view) {
        (Some(uri), _) => photometry::parse(&resource::fetch(&uri, document.folder, &mut MAX_BYTES.clone())?),
        (None, Some(view)) => {
            let (bytes, _) =
                document.view(Index::new(view), || EXTENSION.to_owned()).map_err(|cause| cause.to_string())?;
            photometry::parse(bytes)
        }
        (None, None) => Err("it has neither uri nor bufferView".to_owned()),
    };
    table.map(Arc::new)
}

/// Returns the light at its position in the world, in group 0 until groups are assigned. Its intensities are those of a
/// photometric file times `factor`; `None` if they are zero.
///
/// # Errors
/// Returns an error if the intensity is not plausible.
pub(crate) fn placed(
    photometry: Arc<Photometry>,
    factor: Vec3,
    name: &str,
    world_from_node: DAffine3,
) -> Result<Option<Light>, Cause> {
    let intensity = factor * photometry.peak();
    if !intensity.is_finite() || intensity.max_element() > MAX_INTENSITY {
        return Err(Cause::NotFinite(format!("the intensity of light {name:?}")));
    }
    if intensity == Vec3::ZERO {
        return Ok(None);
    }
    let world_from_light = DQuat::from_mat3(&frame(world_from_node)).normalize().as_quat();
    let profile = Some(Profile { photometry, world_from_light });
    Ok(Some(Light { name: name.to_owned(), profile, ..Light::point(world_from_node.translation.as_vec3(), intensity) }))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::scene::Scene;
    use crate::scene::gltf::fixture::Fixture;

    /// Uniform in the lower hemisphere, half as strong in the upper one.
    const TABLE: &str = "IES:LM-63-2019\nTILT=NONE\n1 -1 1 4 1 1 2 0 0 0\n1 1 10\n0 90 90.01 180\n0\n40 40 20 20\n";

    /// Returns a node rotated so that its -Z is -Y, with a light of this table.
    fn scene(table: &str, node_light: Value) -> Scene {
        let mut fixture = Fixture::triangle();
        let view = fixture.view(table.as_bytes());
        let profile = json!({"bufferView": view, "mimeType": "application/x-ies-lm-63", "name": "downlight"});
        fixture.json["extensions"] = json!({EXTENSION: {"lights": [profile]}});
        fixture.json["extensionsUsed"] = json!([EXTENSION]);
        let half = std::f32::consts::FRAC_1_SQRT_2;
        fixture.json["nodes"][0] = json!({"translation": [1, 2, 3], "rotation": [-half, 0, 0, half], "scale": [3, 3, 3],
            "extensions": {EXTENSION: node_light}});
        fixture.load()
    }

    #[test]
    fn the_intensity_follows_the_table_the_factor_and_the_rotation_of_the_node() {
        let scene = scene(TABLE, json!({"light": 0, "multiplier": 0.5, "color": [1, 0.5, 2]}));
        let light = &scene.lights[0];
        let (below, above) = (light.arrival(Vec3::new(1.0, 0.0, 3.0)), light.arrival(Vec3::new(1.0, 4.0, 3.0)));
        assert!((below.irradiance - Vec3::new(5.0, 2.5, 5.0)).length() < 1e-4, "{below:?}");
        assert!((above.irradiance - Vec3::new(2.5, 1.25, 2.5)).length() < 1e-4, "{above:?}");
        assert_eq!((scene.light_groups.as_slice(), scene.notes.len()), (["downlight".to_owned()].as_slice(), 1));
        assert!(scene.notes[0].contains("--shadows"), "{:?}", scene.notes);
    }

    #[test]
    fn a_light_without_a_valid_table_is_ignored_with_a_note() {
        for (table, light) in [("nonsense", 0), (TABLE, 7)] {
            let scene = scene(table, json!({"light": light}));
            assert!(scene.lights.is_empty() && scene.notes[0].contains("left out"), "{:?}", scene.notes);
        }
    }
}
