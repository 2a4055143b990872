//! EXT_mesh_gpu_instancing: one node with many instances of its mesh.
//!
//! Source: the extension's specification.

use std::collections::BTreeMap;

use glam::{DAffine3, DQuat, DVec3};
use gltf::json::accessor::Accessor;
use gltf::json::{Index, Node};
use serde::Deserialize;

use crate::scene::gltf::error::Cause;
use crate::scene::gltf::file::accessor::Reader;
use crate::scene::gltf::file::document::Document;

/// Name of the extension.
pub(crate) const EXTENSION: &str = "EXT_mesh_gpu_instancing";

/// The extension's JSON.
#[derive(Deserialize)]
struct Instancing {
    attributes: BTreeMap<String, u32>,
}

fn instancing(node: &Node, index: usize) -> Result<Option<Instancing>, Cause> {
    let extension = node.extensions.as_ref().and_then(|extensions| extensions.others.get(EXTENSION));
    let parsed = extension.map(Instancing::deserialize).transpose();
    parsed.map_err(|error| Cause::Broken(format!("node {index}: {EXTENSION}: {error}")))
}

/// Returns the number of instances of a node's mesh, according to the JSON; 1 without the extension.
///
/// # Errors
/// Returns an error if the extension is invalid.
pub(crate) fn count(document: &Document<'_>, node: &Node, index: usize) -> Result<u64, Cause> {
    let Some(instancing) = instancing(node, index)? else { return Ok(1) };
    let accessors = instancing.attributes.values().filter_map(|&accessor| document.root.get(Index::new(accessor)));
    Ok(accessors.map(|accessor: &Accessor| accessor.count.0).max().unwrap_or(1))
}

/// Returns the transforms from mesh space to node space, one per instance.
///
/// # Errors
/// Returns an error if the extension is invalid or its accessors cannot be read.
pub(crate) fn transforms(document: &Document<'_>, node: &Node, index: usize) -> Result<Vec<DAffine3>, Cause> {
    let Some(instancing) = instancing(node, index)? else { return Ok(vec![DAffine3::IDENTITY]) };
    let rows: Vec<u32> = (0..count(document, node, index)? as u32).collect();
    let reader = |name: &str| {
        let accessor = instancing.attributes.get(name);
        accessor.map(|&accessor| Reader::new(document, Index::new(accessor), || format!("node {index}"))).transpose()
    };
    let vectors = |name| reader(name)?.map(|reader| reader.vectors::<3>(&rows)).transpose();
    let translations = vectors("TRANSLATION")?;
    let scales = vectors("SCALE")?;
    let rotations = reader("ROTATION")?.map(|reader| reader.vectors::<4>(&rows)).transpose()?;
    let vector = |xyz: [f32; 3]| DVec3::from(xyz.map(f64::from));
    let transform = |row: usize| {
        let rotation = rotations.as_ref().map(|rotations| DQuat::from_array(rotations[row].map(f64::from)));
        DAffine3::from_scale_rotation_translation(
            scales.as_ref().map_or(DVec3::ONE, |scales| vector(scales[row])),
            rotation.filter(|rotation| rotation.length_squared() > 0.0).map_or(DQuat::IDENTITY, DQuat::normalize),
            translations.as_ref().map_or(DVec3::ZERO, |translations| vector(translations[row])),
        )
    };
    Ok((0..rows.len()).map(transform).collect())
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use serde_json::json;

    use crate::scene::gltf::fixture::Fixture;

    #[test]
    fn every_transform_makes_an_instance_below_its_node() {
        let mut fixture = Fixture::triangle();
        let translations = fixture.floats("_TRANSLATIONS", "VEC3", &[1.0, 0.0, 0.0, 0.0, 5.0, 0.0]);
        // A half turn about Z, in normalised bytes.
        let turns = fixture.accessor(5120, "VEC4", 2, &[0, 0, 0, 127, 0, 0, 127, 0]);
        fixture.json["accessors"][turns]["normalized"] = json!(true);
        let attributes = json!({"TRANSLATION": translations, "ROTATION": turns});
        fixture.primitive()["attributes"].as_object_mut().expect("an object").remove("_TRANSLATIONS");
        fixture.json["nodes"][0] = json!({"mesh": 0, "scale": [2, 2, 2],
            "extensions": {"EXT_mesh_gpu_instancing": {"attributes": attributes}}});
        let scene = fixture.load();
        assert_eq!((scene.instances.len(), scene.triangles.len()), (2, 2));
        assert_eq!(scene.vertices[1].position, Vec3::new(4.0, 0.0, 0.0));
        assert!((scene.vertices[4].position - Vec3::new(-2.0, 10.0, 0.0)).length() < 1e-6);
    }

    #[test]
    fn attributes_of_different_lengths_are_refused() {
        let mut fixture = Fixture::triangle();
        let translations = fixture.accessor(5126, "VEC3", 1, &[0; 12]);
        let scales = fixture.accessor(5126, "VEC3", 2, &[0; 24]);
        let attributes = json!({"TRANSLATION": translations, "SCALE": scales});
        fixture.json["nodes"][0]["extensions"] = json!({"EXT_mesh_gpu_instancing": {"attributes": attributes}});
        assert!(fixture.error().contains("row 1 is read"), "{}", fixture.error());
    }

    #[test]
    fn a_thousand_million_instances_are_refused_before_memory_is_allocated() {
        let mut fixture = Fixture::triangle();
        let translations = fixture.accessor(5126, "VEC3", 1_000_000_000, &[0; 12]);
        let attributes = json!({"TRANSLATION": translations});
        fixture.json["nodes"][0]["extensions"] = json!({"EXT_mesh_gpu_instancing": {"attributes": attributes}});
        assert!(fixture.error().contains("too large"), "{}", fixture.error());
    }
}
