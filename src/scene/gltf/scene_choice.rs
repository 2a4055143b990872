//! Selects one of a file's scenes: that of `FILE#NAME` or `FILE#1`, or else the default scene.

use std::path::{Path, PathBuf};

use gltf::json::{Index, Node, Root};

use super::error::Cause;
use super::file::document::Document;

/// Splits `FILE#SCENE` into the file and the scene after `#`. If a file exists whose name contains the `#`, it takes
/// precedence.
pub(super) fn split_scene_name(path: &Path) -> (PathBuf, Option<String>) {
    if let Some((file, scene)) = path.to_str().filter(|_| !path.exists()).and_then(|text| text.rsplit_once('#')) {
        return (PathBuf::from(file), Some(scene.to_owned()));
    }
    (path.to_owned(), None)
}

/// Returns the root nodes of the wanted scene, else of the default scene, else of the first one. Without scenes,
/// returns all nodes that have no parent.
pub(super) fn root_nodes(document: &Document<'_>, wanted: Option<&str>) -> Result<Vec<Index<Node>>, Cause> {
    let root = &document.root;
    let scene = match (wanted, root.scene) {
        (Some(wanted), _) => Some(&root.scenes[scene_index(root, wanted)?]),
        (None, Some(default)) => Some(document.find(default, "scene", || "the file".to_owned())?),
        (None, None) => root.scenes.first(),
    };
    Ok(scene.map_or_else(|| nodes_without_parent(root), |scene| scene.nodes.clone()))
}

/// Returns the index of the wanted scene. A name takes precedence over an index, so that a scene named "1" can be
/// selected.
fn scene_index(root: &Root, wanted: &str) -> Result<usize, Cause> {
    let by_name = root.scenes.iter().position(|scene| scene.name.as_deref() == Some(wanted));
    let by_index = || wanted.parse().ok().filter(|&index: &usize| index < root.scenes.len());
    by_name.or_else(by_index).ok_or_else(|| {
        let names = root.scenes.iter().enumerate().map(|(i, scene)| match &scene.name {
            Some(name) => format!("#{i} {name:?}"),
            None => format!("#{i}"),
        });
        let available = names.collect::<Vec<_>>().join(", ");
        let available = if available.is_empty() { "none".to_owned() } else { available };
        Cause::NoSuchScene { wanted: wanted.to_owned(), available }
    })
}

fn nodes_without_parent(root: &Root) -> Vec<Index<Node>> {
    let mut is_root = vec![true; root.nodes.len()];
    for child in root.nodes.iter().flat_map(|node| node.children.iter().flatten()) {
        if let Some(is_root) = is_root.get_mut(child.value()) {
            *is_root = false;
        }
    }
    (0..).zip(is_root).filter(|&(_, is_root)| is_root).map(|(i, _)| Index::new(i)).collect()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use serde_json::json;

    use super::super::fixture::Fixture;
    use super::super::load;

    #[test]
    fn a_scene_is_chosen_by_name_or_index() {
        let mut fixture = Fixture::triangle();
        fixture.json["scenes"] = json!([{"nodes": [0]}, {"name": "empty"}]);
        let folder = tempfile::tempdir().expect("a folder for the test");
        let file = folder.path().join("two.gltf");
        std::fs::write(&file, fixture.to_bytes()).expect("it can be written");
        let load_part = |part: &str| load(Path::new(&format!("{}{part}", file.display())));
        let triangles = |part: &str| load_part(part).expect("there is such a scene").triangles.len();
        assert_eq!([triangles(""), triangles("#0"), triangles("#1"), triangles("#empty")], [1, 1, 0, 0]);
        let error = load_part("#attic").expect_err("there is no such scene").to_string();
        assert!(error.ends_with("it has no scene \"attic\"; there is #0, #1 \"empty\""), "{error}");
    }

    #[test]
    fn without_scenes_all_roots_are_shown() {
        let mut fixture = Fixture::triangle();
        fixture.json["nodes"] = json!([{"mesh": 0}, {"children": [0]}, {"mesh": 0}]);
        let root = fixture.json.as_object_mut().expect("an object");
        root.remove("scene");
        root.remove("scenes");
        assert_eq!(fixture.load().triangles.len(), 2);
    }
}
