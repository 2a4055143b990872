//! The tree of nodes that a file has: applied on loading, and kept for programs that move nodes.

use std::ops::Range;

use glam::{DAffine3, DMat4, DQuat, DVec3};

/// A node of the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NamedNode {
    /// Its name; may be empty.
    pub name: String,
    /// The node above it, which comes before it in [`super::Scene::nodes`].
    pub parent: Option<usize>,
    /// Where it stands in the node above it.
    pub transform: Transform,
    /// What it shows, as a range of [`super::Scene::instances`].
    pub instances: Range<usize>,
    /// The light that it carries, by its number.
    pub light: Option<usize>,
    /// The camera that it carries, by its number.
    pub camera: Option<usize>,
}

/// Place, turn and size of a node in the one above it, told as the file tells it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Transform {
    /// Column by column.
    Matrix([f32; 16]),
    /// What animations move.
    Parts {
        /// Metres.
        translation: [f32; 3],
        /// Unit quaternion x, y, z, w.
        rotation: [f32; 4],
        /// Along the node's axes.
        scale: [f32; 3],
    },
}

impl Default for Transform {
    fn default() -> Self {
        Self::Parts { translation: [0.0; 3], rotation: [0.0, 0.0, 0.0, 1.0], scale: [1.0; 3] }
    }
}

impl Transform {
    /// The nearest that a file can tell.
    #[must_use]
    pub fn from_affine(parent_from_node: DAffine3) -> Self {
        Self::Matrix(DMat4::from(parent_from_node).to_cols_array().map(|x| x as f32))
    }

    /// From the node's space to that of the node above it.
    #[must_use]
    pub fn parent_from_node(&self) -> DAffine3 {
        match *self {
            Self::Matrix(columns) => DAffine3::from_mat4(DMat4::from_cols_array(&columns.map(f64::from))),
            Self::Parts { translation, rotation, scale } => {
                let rotation = DQuat::from_array(rotation.map(f64::from));
                DAffine3::from_scale_rotation_translation(
                    DVec3::from(scale.map(f64::from)),
                    if rotation.length_squared() > 0.0 { rotation.normalize() } else { DQuat::IDENTITY },
                    DVec3::from(translation.map(f64::from)),
                )
            }
        }
    }
}
