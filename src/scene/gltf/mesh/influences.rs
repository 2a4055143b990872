//! Joints and weights of the vertices of a skinned primitive.
//!
//! Source: glTF 2.0, section 3.7.3.3.

use gltf::json::mesh::Semantic;

use super::attributes::Attributes;
use crate::scene::gltf::error::Cause;

/// Most sets of four joints per vertex.
const MAX_SETS: u32 = 4;

/// Index of a joint in its skin, and its weight.
pub(crate) type Influence = (usize, f32);

/// Influences of each vertex: JOINTS_n with WEIGHTS_n, without those of weight zero; empty if the primitive has no
/// joints.
///
/// # Errors
/// Returns an error if an accessor cannot be read.
pub(crate) fn influences(attributes: &Attributes<'_>, rows: &[u32]) -> Result<Vec<Vec<Influence>>, Cause> {
    let mut influences = Vec::new();
    for set in 0..MAX_SETS {
        let joints = attributes.vectors::<4>(Semantic::Joints(set), rows)?;
        let weights = attributes.vectors::<4>(Semantic::Weights(set), rows)?;
        let Some((joints, weights)) = joints.zip(weights) else { break };
        influences.resize(rows.len(), Vec::new());
        for (vertex, (joints, weights)) in influences.iter_mut().zip(joints.into_iter().zip(weights)) {
            let pairs = joints.map(|joint| joint as usize).into_iter().zip(weights);
            vertex.extend(pairs.filter(|&(_, weight)| weight > 0.0));
        }
    }
    Ok(influences)
}
