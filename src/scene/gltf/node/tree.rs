//! Flattening of the node tree: every visible node with its world transform.

use glam::{DAffine3, DMat3, DVec3};
use gltf::json::{Index, Node};

use crate::scene::Transform;
use crate::scene::gltf::error::Cause;
use crate::scene::gltf::file::document::Document;

/// Largest number of levels of a node tree.
const MAX_DEPTH: usize = 256;

/// A node of the file with its world transform.
pub(crate) struct PlacedNode<'a> {
    /// Index in the file.
    pub index: usize,
    /// The node.
    pub node: &'a Node,
    /// Index of the parent in the list of all visible nodes; `None` for a root.
    pub parent: Option<usize>,
    /// Transform from node space to world space.
    pub world_from_node: DAffine3,
}

/// Returns all visible nodes at and below `roots`, parents before children.
///
/// # Errors
/// Returns an error if a node is its own ancestor or has two parents, the tree is too deep, or a transform is not
/// finite.
pub(crate) fn flatten<'a>(document: &'a Document<'_>, roots: &[Index<Node>]) -> Result<Vec<PlacedNode<'a>>, Cause> {
    let mut walk = Walk { document, is_visited: vec![false; document.root.nodes.len()], placed: Vec::new() };
    for &root in roots {
        walk.visit(root, None, DAffine3::IDENTITY, 0)?;
    }
    Ok(walk.placed)
}

struct Walk<'a, 'f> {
    document: &'a Document<'f>,
    is_visited: Vec<bool>,
    placed: Vec<PlacedNode<'a>>,
}

impl Walk<'_, '_> {
    fn visit(
        &mut self,
        id: Index<Node>,
        parent: Option<usize>,
        world_from_parent: DAffine3,
        depth: usize,
    ) -> Result<(), Cause> {
        let node = self.document.find(id, "node", || "the node tree".to_owned())?;
        let index = id.value();
        if depth > MAX_DEPTH {
            return Err(Cause::TooDeep(MAX_DEPTH));
        }
        if std::mem::replace(&mut self.is_visited[index], true) {
            return Err(Cause::NodeTwice(index));
        }
        if is_hidden(node) {
            return Ok(());
        }
        let world_from_node = world_from_parent * transform(node).parent_from_node();
        if !world_from_node.is_finite() {
            return Err(Cause::NotFinite(format!("the transform of node {index}")));
        }
        let child_parent = Some(self.placed.len());
        self.placed.push(PlacedNode { index, node, parent, world_from_node });
        let children = node.children.iter().flatten();
        children.copied().try_for_each(|child| self.visit(child, child_parent, world_from_node, depth + 1))
    }
}

fn is_hidden(node: &Node) -> bool {
    let visibility = node.extensions.as_ref().and_then(|extensions| extensions.others.get("KHR_node_visibility"));
    visibility.is_some_and(|visibility| visibility["visible"] == false)
}

/// Returns the transform of a node to its parent.
pub(crate) fn transform(node: &Node) -> Transform {
    match (node.matrix, Transform::default()) {
        (Some(matrix), _) => Transform::Matrix(matrix),
        (None, Transform::Parts { translation, rotation, scale }) => Transform::Parts {
            translation: node.translation.unwrap_or(translation),
            rotation: node.rotation.map_or(rotation, |rotation| rotation.0),
            scale: node.scale.unwrap_or(scale),
        },
        (None, other) => other,
    }
}

/// Returns the first of two names that is not blank, or else a name from `kind` and `index`.
pub(crate) fn name_of(names: [&Option<String>; 2], kind: &str, index: usize) -> String {
    let given = names.into_iter().flatten().find(|name| !name.trim().is_empty());
    given.cloned().unwrap_or_else(|| format!("{kind} {index}"))
}

/// Returns the orientation of a node without its scale, shear and mirroring, for lights and cameras. The result has
/// right-handed orthonormal axes: the node's +Z exactly, and its +Y made perpendicular to it.
pub(crate) fn frame(world_from_node: DAffine3) -> DMat3 {
    let z = world_from_node.matrix3.z_axis.try_normalize().unwrap_or(DVec3::Z);
    let across = world_from_node.matrix3.y_axis.cross(z);
    let x = across.try_normalize().unwrap_or_else(|| z.any_orthonormal_vector());
    DMat3::from_cols(x, z.cross(x), z)
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use crate::scene::gltf::fixture::Fixture;

    #[test]
    fn loops_and_second_parents_are_refused() {
        let loops = json!([{"children": [1]}, {"children": [0]}]);
        let second_parent = json!([{"children": [1, 2]}, {"children": [2]}, {"mesh": 0}]);
        for (nodes, culprit) in [(loops, "node 0"), (second_parent, "node 2")] {
            let mut fixture = Fixture::triangle();
            fixture.json["nodes"] = nodes;
            assert!(fixture.error().contains(&format!("{culprit} occurs twice")), "{}", fixture.error());
        }
    }

    #[test]
    fn a_tree_that_is_too_deep_is_refused() {
        let mut fixture = Fixture::triangle();
        let chain: Vec<Value> = (1..=1000).map(|child| json!({"children": [child]})).collect();
        fixture.json["nodes"] = json!(chain);
        fixture.json["nodes"].as_array_mut().expect("a list").push(json!({"mesh": 0}));
        assert!(fixture.error().contains("deeper than 256"), "{}", fixture.error());
    }

    #[test]
    fn transforms_are_multiplied_down_the_tree() {
        let mut fixture = Fixture::triangle();
        fixture.json["nodes"] = json!([{"scale": [2, 2, 2], "children": [1]}, {"translation": [1, 0, 0], "mesh": 0}]);
        assert_eq!(fixture.load().vertices[1].position.x, 4.0);
    }

    #[test]
    fn hidden_nodes_are_skipped() {
        let mut fixture = Fixture::triangle();
        fixture.json["nodes"][0]["extensions"] = json!({"KHR_node_visibility": {"visible": false}});
        assert!(fixture.load().triangles.is_empty());
    }
}
