//! Morph targets in their rest pose: with the weights of the node, or else of the mesh.
//!
//! Source: glTF 2.0, section 3.7.2.2.

use glam::Vec3;
use gltf::json::Node;
use gltf::json::mesh::{Mesh, MorphTarget};

use super::attributes::Attributes;
use crate::scene::Vertex;
use crate::scene::gltf::error::Cause;

/// Returns the weights of the morph targets of a mesh at this node; missing weights are zero.
pub(crate) fn weights<'a>(node: &'a Node, mesh: &'a Mesh) -> &'a [f32] {
    node.weights.as_deref().or(mesh.weights.as_deref()).unwrap_or_default()
}

/// Adds the weighted displacements of the targets to the vertices.
///
/// # Errors
/// Returns an error if an accessor cannot be read.
pub(crate) fn apply(
    attributes: &Attributes<'_>,
    targets: &[MorphTarget],
    weights: &[f32],
    rows: &[u32],
    vertices: &mut [Vertex],
) -> Result<(), Cause> {
    for (target, &weight) in targets.iter().zip(weights).filter(|&(_, &weight)| weight != 0.0) {
        if let Some(index) = target.positions {
            let moved = attributes.open(index)?.vectors::<3>(rows)?;
            vertices.iter_mut().zip(moved).for_each(|(vertex, by)| vertex.position += weight * Vec3::from(by));
        }
        if let Some(index) = target.normals {
            let moved = attributes.open(index)?.vectors::<3>(rows)?;
            vertices.iter_mut().zip(moved).for_each(|(vertex, by)| vertex.normal += weight * Vec3::from(by));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use crate::scene::gltf::fixture::Fixture;

    /// Returns a triangle with a target that lifts its last corner by one along Z.
    fn morphing() -> Fixture {
        let mut fixture = Fixture::triangle();
        let lift = fixture.floats("_LIFT", "VEC3", &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
        fixture.primitive()["targets"] = json!([{"POSITION": lift}]);
        fixture
    }

    #[test]
    fn weights_of_the_node_override_those_of_the_mesh() {
        let mut fixture = morphing();
        let height = |fixture: &Fixture| fixture.load().vertices[2].position.z;
        assert_eq!(height(&fixture), 0.0);
        fixture.json["meshes"][0]["weights"] = json!([0.5]);
        assert_eq!(height(&fixture), 0.5);
        fixture.json["nodes"][0]["weights"] = json!([2.0]);
        assert_eq!(height(&fixture), 2.0);
    }

    #[test]
    fn nodes_with_different_weights_show_different_shapes() {
        let mut fixture = morphing();
        fixture.json["nodes"] = json!([{"mesh": 0}, {"mesh": 0, "weights": [1]}]);
        fixture.json["scenes"][0]["nodes"] = json!([0, 1]);
        let scene = fixture.load();
        assert_eq!([2, 5].map(|v: usize| scene.vertices[v].position.z), [0.0, 1.0]);
    }
}
