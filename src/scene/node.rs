//! The node tree of a file. Its transforms are applied on loading. A bake writes the tree for programs that move nodes.

use std::ops::Range;

use glam::{DAffine3, DMat4, DQuat, DVec3};

/// A node of the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NamedNode {
    /// Name of the node; may be empty.
    pub name: String,
    /// Index of the parent in [`Scene::nodes`](super::Scene::nodes), lower than its own; `None` for a root.
    pub parent: Option<usize>,
    /// Transform to its parent.
    pub transform: Transform,
    /// Instances of the node, as a range of [`Scene::instances`](super::Scene::instances).
    pub instances: Range<usize>,
    /// Index of its light in the scene; `None` if it has none.
    pub light: Option<usize>,
    /// Index of its camera in the scene; `None` if it has none.
    pub camera: Option<usize>,
}

/// Transform of a node to its parent, in the form of the file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Transform {
    /// A 4 x 4 matrix, column by column.
    Matrix([f32; 16]),
    /// Translation x rotation x scale, which animations can change.
    Parts {
        /// Translation, metres.
        translation: [f32; 3],
        /// Unit quaternion x, y, z, w.
        rotation: [f32; 4],
        /// Scale along the node's axes.
        scale: [f32; 3],
    },
}

impl Default for Transform {
    fn default() -> Self {
        Self::Parts { translation: [0.0; 3], rotation: [0.0, 0.0, 0.0, 1.0], scale: [1.0; 3] }
    }
}

impl Transform {
    /// Returns the matrix of a transform, rounded to single precision as in a file.
    #[must_use]
    pub fn from_affine(parent_from_node: DAffine3) -> Self {
        Self::Matrix(DMat4::from(parent_from_node).to_cols_array().map(|x| x as f32))
    }

    /// Returns the transform from node space to the space of the parent.
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
