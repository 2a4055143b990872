//! The triangles of nodes as meshes: one primitive for each material and side.

use std::collections::{BTreeMap, HashMap};

use glam::Vec4;
use serde_json::{Map, Value, json};

use super::binary::Binary;
use super::elements::Elements;
use super::hierarchy::{Branch, Space};
use super::json::named;
use super::light_storage::LightStorage;
use super::material::texture_slots;
use super::moz_lightmap;
use crate::base::ids::{MaterialId, TriangleId};
use crate::scene::{Material, Scene, Vertex};

/// Returns one mesh for each branch (glTF node) that has triangles, in their order.
pub(super) fn meshes(scene: &Scene, branches: &[Branch], light: LightStorage<'_>, binary: &mut Binary) -> Vec<Value> {
    let elements = match light {
        LightStorage::Vertices { trees, .. } => Some(Elements::new(scene, trees)),
        LightStorage::None | LightStorage::Texture { .. } => None,
    };
    let drawn = branches.iter().filter(|branch| !branch.triangles.is_empty());
    drawn.map(|branch| mesh(scene, light, elements.as_ref(), branch, binary)).collect()
}

fn mesh(
    scene: &Scene,
    light: LightStorage<'_>,
    elements: Option<&Elements<'_>>,
    branch: &Branch,
    binary: &mut Binary,
) -> Value {
    let mut parts: BTreeMap<(MaterialId, bool), Vec<TriangleId>> = BTreeMap::new();
    for triangle in branch.triangles.clone().map(TriangleId::new) {
        let key = (scene.triangles[triangle.index()].material, scene.sides.is_back(triangle));
        parts.entry(key).or_default().push(triangle);
    }
    let corners = |triangle: &TriangleId| {
        let [a, b, c] = scene.triangles[triangle.index()].vertices;
        if branch.space.is_mirrored() { [a, c, b] } else { [a, b, c] }
    };
    let mut primitives: Vec<Value> = Vec::with_capacity(parts.len());
    let mut front: Option<(MaterialId, &[TriangleId])> = None;
    for (&(material, is_back), triangles) in &parts {
        let (vertices, indices) = renumber(&triangles.iter().map(corners).collect::<Vec<_>>());
        let mut primitive = json!({
            "attributes": attributes(scene, light, &branch.space, material, &vertices, binary),
            "indices": binary.push_indices(&indices, vertices.len()),
            "material": material.index(),
        });
        let mut extras = Map::new();
        if is_back {
            extras.insert("back_side".into(), json!(true));
        }
        // The primitive with the fronts of a material directly precedes that with its backs.
        let fronts = front.filter(|(of, _)| is_back && *of == material).map(|(_, fronts)| fronts);
        if let Some(record) = elements.and_then(|elements| elements.record(triangles, fronts)) {
            extras.insert("elements".into(), record);
        }
        if !extras.is_empty() {
            primitive["extras"] = Value::Object(extras);
        }
        primitives.push(primitive);
        front = (!is_back).then_some((material, triangles));
    }
    let mut mesh = named(&branch.name);
    mesh["primitives"] = json!(primitives);
    mesh
}

/// Returns the vertices that triangles use, in the order of first use, and the triangles as indices of these.
fn renumber(triangles: &[[u32; 3]]) -> (Vec<u32>, Vec<u32>) {
    let mut vertices = Vec::new();
    let mut number = HashMap::new();
    let indices = triangles
        .as_flattened()
        .iter()
        .map(|&vertex| {
            *number.entry(vertex).or_insert_with(|| {
                vertices.push(vertex);
                vertices.len() as u32 - 1
            })
        })
        .collect();
    (vertices, indices)
}

/// Adds accessors of the attributes. An attribute whose values are all default values is left out.
fn attributes(
    scene: &Scene,
    light: LightStorage<'_>,
    space: &Space,
    material: MaterialId,
    vertices: &[u32],
    binary: &mut Binary,
) -> Map<String, Value> {
    let material = &scene.materials[material.index()];
    let mut attributes = Map::new();
    let mut put = |name: String, accessor: usize| attributes.insert(name, json!(accessor));
    let used = || vertices.iter().map(|&v| &scene.vertices[v as usize]);
    put("POSITION".into(), binary.push_positions(used().map(|vertex| space.position(vertex.position).to_array())));
    put("NORMAL".into(), binary.push_attribute(used().map(|vertex| space.normal(vertex.normal).to_array())));
    let num_uv_sets = match light {
        LightStorage::Texture { .. } => moz_lightmap::uv_set(material),
        LightStorage::None | LightStorage::Vertices { .. } => num_uv_sets(material, used()),
    };
    for set in 0..num_uv_sets {
        let coordinates = used().map(|vertex| vertex.uv[set].to_array());
        put(format!("TEXCOORD_{set}"), binary.push_attribute(coordinates));
    }
    if let LightStorage::Texture { lightmap, .. } = light {
        let coordinates = vertices.iter().map(|&v| lightmap.coordinates[v as usize].to_array());
        put(format!("TEXCOORD_{num_uv_sets}"), binary.push_attribute(coordinates));
    }
    let is_painted = used().any(|vertex| vertex.colour != Vec4::ONE);
    if let LightStorage::Vertices { appearance, .. } = light {
        // COLOR_0 shows the light, and _COLOR holds the original colour. All custom attributes have three components,
        // because Blender's importer confuses attributes with different numbers of components.
        put(
            "COLOR_0".into(),
            binary.push_colours(vertices.iter().map(|&v| appearance.colour(scene, material, v).to_array())),
        );
        if is_painted {
            put("_COLOR".into(), binary.push_attribute(used().map(|vertex| vertex.colour.truncate().to_array())));
        }
        if used().any(|vertex| vertex.colour.w != 1.0) {
            put("_ALPHA".into(), binary.push_attribute(used().map(|vertex| [vertex.colour.w; 3])));
        }
        for (g, group) in appearance.light.groups.iter().enumerate() {
            for (part, values) in [("DIRECT", &group.direct), ("INDIRECT", &group.indirect)] {
                let values = vertices.iter().map(|&v| values[v as usize].to_array());
                put(format!("_IRRADIANCE_{part}_{g}"), binary.push_attribute(values));
            }
        }
    } else if is_painted {
        put("COLOR_0".into(), binary.push_attribute(used().map(|vertex| vertex.colour.to_array())));
    }
    attributes
}

/// Returns the number of texture coordinate sets, from 0 on, up to the last that is not 0 or that the material reads;
/// glTF allows no gaps.
fn num_uv_sets<'a>(material: &Material, vertices: impl Iterator<Item = &'a Vertex> + Clone) -> usize {
    let read = texture_slots(material).map(|slot| slot.uv_set + 1).max().unwrap_or(0);
    let holds = |set: usize| vertices.clone().any(|vertex| vertex.uv[set] != glam::Vec2::ZERO);
    let held = (0..2).rev().find(|&set| holds(set)).map_or(0, |set| set + 1);
    read.max(held)
}
