//! What nodes show, as meshes: one primitive for each material and side.

use std::collections::{BTreeMap, HashMap};

use glam::Vec4;
use serde_json::{Map, Value, json};

use super::binary::Binary;
use super::hierarchy::{Branch, Space};
use super::material::texture_slots;
use super::{LightOf, moz_lightmap, named};
use crate::base::ids::{MaterialId, TriangleId};
use crate::scene::{Material, Scene, Vertex};

/// One mesh a branch that has triangles, in their order.
pub(super) fn meshes(scene: &Scene, branches: &[Branch], light: LightOf<'_>, binary: &mut Binary) -> Vec<Value> {
    let drawn = branches.iter().filter(|branch| !branch.triangles.is_empty());
    drawn.map(|branch| mesh(scene, light, branch, binary)).collect()
}

fn mesh(scene: &Scene, light: LightOf<'_>, branch: &Branch, binary: &mut Binary) -> Value {
    let mut parts: BTreeMap<(MaterialId, bool), Vec<[u32; 3]>> = BTreeMap::new();
    for t in branch.triangles.clone() {
        let triangle = &scene.triangles[t];
        let [a, b, c] = triangle.vertices;
        let corners = if branch.space.is_mirrored() { [a, c, b] } else { [a, b, c] };
        parts.entry((triangle.material, scene.sides.is_back(TriangleId::new(t)))).or_default().push(corners);
    }
    let primitives: Vec<Value> = parts
        .into_iter()
        .map(|((material, is_back), triangles)| {
            let (vertices, indices) = renumber(&triangles);
            let mut primitive = json!({
                "attributes": attributes(scene, light, &branch.space, material, &vertices, binary),
                "indices": binary.push_indices(&indices, vertices.len()),
                "material": material.index(),
            });
            if is_back {
                primitive["extras"] = json!({ "back_side": true });
            }
            primitive
        })
        .collect();
    let mut mesh = named(&branch.name);
    mesh["primitives"] = json!(primitives);
    mesh
}

/// The scene vertices that the triangles use, in the order of first use, and the triangles in those numbers.
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

/// Accessors of the attributes that say something; what is left out reads back as its default.
fn attributes(
    scene: &Scene,
    light: LightOf<'_>,
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
        LightOf::Texture { .. } => moz_lightmap::uv_set(material),
        LightOf::Nothing | LightOf::Vertices(_) => num_uv_sets(material, used()),
    };
    for set in 0..num_uv_sets {
        let coordinates = used().map(|vertex| vertex.uv[set].to_array());
        put(format!("TEXCOORD_{set}"), binary.push_attribute(coordinates));
    }
    if let LightOf::Texture { lightmap, .. } = light {
        let coordinates = vertices.iter().map(|&v| lightmap.coordinates[v as usize].to_array());
        put(format!("TEXCOORD_{num_uv_sets}"), binary.push_attribute(coordinates));
    }
    let is_painted = used().any(|vertex| vertex.colour != Vec4::ONE);
    if let LightOf::Vertices(look) = light {
        // COLOR_0 shows the light, and the paint lies beside it. All attributes of ours are triples, because Blender's
        // importer mixes up such as are not alike.
        put(
            "COLOR_0".into(),
            binary.push_colours(vertices.iter().map(|&v| look.colour(scene, material, v).to_array())),
        );
        if is_painted {
            put("_COLOR".into(), binary.push_attribute(used().map(|vertex| vertex.colour.truncate().to_array())));
        }
        if used().any(|vertex| vertex.colour.w != 1.0) {
            put("_ALPHA".into(), binary.push_attribute(used().map(|vertex| [vertex.colour.w; 3])));
        }
        for (g, group) in look.light.groups.iter().enumerate() {
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

/// Texture coordinate sets from 0 on that hold something or that the material reads; glTF allows no gaps.
fn num_uv_sets<'a>(material: &Material, vertices: impl Iterator<Item = &'a Vertex> + Clone) -> usize {
    let read = texture_slots(material).map(|slot| slot.uv_set + 1).max().unwrap_or(0);
    let holds = |set: usize| vertices.clone().any(|vertex| vertex.uv[set] != glam::Vec2::ZERO);
    let held = (0..2).rev().find(|&set| holds(set)).map_or(0, |set| set + 1);
    read.max(held)
}
