//! Limit on the size of a scene, predicted from the counts in the JSON before any memory is allocated.
//!
//! Instances multiply: a file of a few kilobytes can describe more triangles than fit into memory.

use gltf::json::Index;
use gltf::json::accessor::Accessor;
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::Checked;

use super::error::Cause;
use super::file::document::Document;
use super::node::instancing;
use super::node::tree::PlacedNode;

/// Largest number of vertices or triangles of a scene: about 2 GB.
const MAX_COUNT: u64 = 32_000_000;

/// Checks that the scene, with all instances, stays within the limit.
///
/// # Errors
/// Returns an error if the scene has more than [`MAX_COUNT`] vertices or triangles.
pub(super) fn check(document: &Document<'_>, nodes: &[PlacedNode<'_>]) -> Result<(), Cause> {
    let mut size = 0u64;
    for placed in nodes {
        let Some(mesh) = placed.node.mesh.and_then(|mesh| document.root.get(mesh)) else { continue };
        let num_instances = instancing::count(document, placed.node, placed.index)?;
        let once = mesh.primitives.iter().map(|primitive| predicted_size(document, primitive));
        size = size.saturating_add(once.fold(0, u64::saturating_add).max(1).saturating_mul(num_instances));
    }
    if size > MAX_COUNT {
        return Err(Cause::TooLarge(format!(
            "its instances have up to {size} vertices or triangles, and at most {MAX_COUNT} are loaded"
        )));
    }
    Ok(())
}

/// Returns an upper bound of the number of vertices and triangles of a primitive.
fn predicted_size(document: &Document<'_>, primitive: &Primitive) -> u64 {
    let count = |index: Index<Accessor>| document.root.get(index).map_or(0, |accessor| accessor.count.0);
    let attribute = |semantic| primitive.attributes.get(&Checked::Valid(semantic)).copied();
    let positions = attribute(Semantic::Positions).map_or(0, count);
    let corners = primitive.indices.map_or(positions, count);
    let triangles = match primitive.mode {
        Checked::Valid(Mode::TriangleStrip | Mode::TriangleFan) => corners,
        _ => corners / 3,
    };
    // Without normals every triangle gets its own vertices, for flat shading.
    let vertices = match attribute(Semantic::Normals) {
        Some(_) => positions.min(corners),
        None => triangles.saturating_mul(3),
    };
    vertices.max(triangles)
}
