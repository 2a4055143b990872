//! Skins in their rest pose: linear blend skinning with the joints at the transforms of the file's nodes.
//!
//! A vertex with weights w_j is transformed from mesh space to world space by sum_j w_j W_j B_j / sum_j w_j, with the
//! world transform W_j and the inverse bind matrix B_j of joint j. The transform of the mesh's own node is ignored.
//!
//! Source: glTF 2.0, section 3.7.3.

use std::collections::HashMap;

use glam::{DAffine3, DMat4};
use gltf::json;
use gltf::json::{Index, Node};
use serde::Deserialize;

use super::attributes::Influence;
use super::geometry::{Geometry, normal_matrix};
use crate::scene::gltf::error::Cause;
use crate::scene::gltf::file::accessor::Reader;
use crate::scene::gltf::file::document::Document;
use crate::scene::gltf::node::tree::PlacedNode;

/// A skin of the file.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Skin {
    joints: Vec<u32>,
    inverse_bind_matrices: Option<u32>,
}

/// Returns the transforms W_j B_j from mesh space to world space of a skin's joints `[joint]`.
///
/// `world_from_node` holds the visible nodes by their index in the file.
///
/// # Errors
/// Returns an error if the skin does not exist, is invalid, or has a joint that is not in the scene.
pub(crate) fn world_from_joints(
    document: &Document<'_>,
    index: Index<json::Skin>,
    world_from_node: &HashMap<usize, DAffine3>,
    user: impl Fn() -> String,
) -> Result<Vec<DAffine3>, Cause> {
    let dangling = |kind, index| Cause::DanglingIndex { user: user(), kind, index };
    let skin = document.skins.get(index.value()).ok_or_else(|| dangling("skin", index.value()))?;
    let skin = Skin::deserialize(skin).map_err(|error| Cause::Broken(format!("skin {index}: {error}")))?;
    let inverse_bind = match skin.inverse_bind_matrices {
        Some(accessor) => inverse_bind_matrices(document, Index::new(accessor), index, skin.joints.len())?,
        None => vec![DAffine3::IDENTITY; skin.joints.len()],
    };
    let joints = skin.joints.iter().zip(inverse_bind).map(|(&joint, joint_from_mesh)| {
        let world_from_joint = world_from_node.get(&(joint as usize));
        let world_from_joint = world_from_joint.ok_or_else(|| {
            Cause::Broken(format!("skin {index} has the joint node {joint}, which is not in the scene"))
        })?;
        Ok(*world_from_joint * joint_from_mesh)
    });
    joints.collect()
}

fn inverse_bind_matrices(
    document: &Document<'_>,
    accessor: Index<json::Accessor>,
    skin: Index<json::Skin>,
    num_joints: usize,
) -> Result<Vec<DAffine3>, Cause> {
    let reader = Reader::new(document, accessor, || format!("skin {skin}"))?;
    let rows: Vec<u32> = (0..num_joints as u32).collect();
    let matrices = reader.vectors::<16>(&rows)?;
    Ok(matrices.into_iter().map(|matrix| DAffine3::from_mat4(DMat4::from_cols_array(&matrix.map(f64::from)))).collect())
}

/// Returns the world transforms of the nodes by their index in the file.
pub(crate) fn world_from_nodes(nodes: &[PlacedNode<'_>]) -> HashMap<usize, DAffine3> {
    nodes.iter().map(|placed| (placed.index, placed.world_from_node)).collect()
}

/// Returns the skin that deforms a primitive of this node; `None` if the node has no skin or the primitive has no
/// joints.
pub(crate) fn of_node(node: &Node, geometry: &Geometry) -> Option<Index<json::Skin>> {
    node.skin.filter(|_| !geometry.influences.is_empty())
}

/// Returns the skinned geometry in world space.
///
/// # Errors
/// Returns an error if a vertex refers to a joint that the skin does not have.
pub(crate) fn posed(geometry: &Geometry, world_from_joints: &[DAffine3]) -> Result<Geometry, Cause> {
    let mut posed = geometry.clone();
    for (vertex, influences) in posed.vertices.iter_mut().zip(&geometry.influences) {
        let world_from_mesh = blended(influences, world_from_joints)?;
        vertex.position = world_from_mesh.transform_point3(vertex.position.as_dvec3()).as_vec3();
        vertex.normal = (normal_matrix(world_from_mesh.matrix3) * vertex.normal.as_dvec3()).as_vec3();
    }
    Ok(posed)
}

/// Returns the weighted mean of the joints' transforms.
fn blended(influences: &[Influence], world_from_joints: &[DAffine3]) -> Result<DAffine3, Cause> {
    let total: f64 = influences.iter().map(|&(_, weight)| f64::from(weight)).sum();
    let mut sum = DAffine3 { matrix3: glam::DMat3::ZERO, translation: glam::DVec3::ZERO };
    for &(joint, weight) in influences {
        let joint = world_from_joints
            .get(joint)
            .ok_or_else(|| Cause::Broken(format!("a vertex refers to joint {joint}, which its skin does not have")))?;
        let share = f64::from(weight) / total;
        sum.matrix3 += joint.matrix3 * share;
        sum.translation += joint.translation * share;
    }
    Ok(if total > 0.0 { sum } else { DAffine3::IDENTITY })
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use serde_json::json;

    use crate::scene::gltf::fixture::Fixture;

    /// Returns a triangle whose first two corners follow joint 0. Its last corner follows joint 0 and joint 1, which is
    /// 2 higher, by half each.
    fn skinned() -> Fixture {
        let mut fixture = Fixture::triangle();
        let joints = fixture.accessor(5121, "VEC4", 3, &[0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0]);
        fixture.primitive()["attributes"]["JOINTS_0"] = json!(joints);
        fixture.floats("WEIGHTS_0", "VEC4", &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.5, 0.5, 0.0, 0.0]);
        fixture.json["nodes"] =
            json!([{"mesh": 0, "skin": 0, "translation": [50, 0, 0]}, {"children": [2]}, {"translation": [0, 0, 2]}]);
        fixture.json["scenes"][0]["nodes"] = json!([0, 1]);
        fixture.json["skins"] = json!([{"joints": [1, 2]}]);
        fixture
    }

    #[test]
    fn vertices_follow_their_joints_and_not_the_node_of_the_mesh() {
        let scene = skinned().load();
        let positions = [0, 1, 2].map(|v: usize| scene.vertices[v].position);
        assert_eq!(positions, [Vec3::ZERO, Vec3::X, Vec3::new(0.0, 1.0, 1.0)]);
    }

    #[test]
    fn inverse_bind_matrices_are_applied_before_the_joints() {
        let mut fixture = skinned();
        let shift = |z: f32| {
            let mut matrix = glam::Mat4::IDENTITY.to_cols_array();
            matrix[14] = z;
            matrix.map(f32::to_le_bytes).concat()
        };
        let matrices = fixture.accessor(5126, "MAT4", 2, &[shift(0.0), shift(-2.0)].concat());
        fixture.json["skins"][0]["inverseBindMatrices"] = json!(matrices);
        assert_eq!(fixture.load().vertices[2].position, Vec3::Y);
    }

    #[test]
    fn invalid_skins_are_reported() {
        let cases = [
            (json!([]), "refers to skin 0"),
            (json!([{"joints": [1]}]), "joint 1, which its skin does not have"),
            (json!([{"joints": [1, 7]}]), "node 7, which is not in the scene"),
            (json!([{"joints": "all"}]), "skin 0"),
            (json!([{"joints": [1, 2], "inverseBindMatrices": 0}]), "elements of 3 numbers where 16"),
        ];
        for (skins, expected) in cases {
            let mut fixture = skinned();
            fixture.json["skins"] = skins;
            assert!(fixture.error().contains(expected), "{}", fixture.error());
        }
    }
}
