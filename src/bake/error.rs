//! Reasons why a bake cannot be done.

use thiserror::Error;

use crate::form_factor::FormFactorError;
use crate::patch::MeshError;
use crate::radiosity::solver::full_matrix::MatrixTooLarge;

/// A bake cannot be done.
#[derive(Debug, Error)]
pub enum BakeError {
    /// The scene cannot be meshed.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The form factors cannot be computed.
    #[error(transparent)]
    FormFactor(#[from] FormFactorError),
    /// Hemicubes were requested without a device that draws them.
    #[error("hemicubes need a device that draws them; the hemisphere method needs none")]
    NoDevice,
    /// The scene is too large for the full matrix.
    #[error(transparent)]
    Matrix(#[from] MatrixTooLarge),
    /// The scene has no light.
    #[error("the scene {0} has no light: no emissive material and no light of KHR_lights_punctual")]
    NoLight(String),
}
