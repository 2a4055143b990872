//! Cutting a scene into a mesh of elements with their optics and patches.

use super::mesh::{MeshSettings, PatchMesh};
use super::splits::Splits;
use super::subdivide::MeshError;
use super::{cluster, optics, propagate};
use crate::scene::Scene;

impl PatchMesh {
    /// Cuts a scene.
    ///
    /// Every edge longer than the element size is split at its midpoint in all triangles that share it, so the elements
    /// are conforming (no vertex lies within an edge) wherever the input is.
    ///
    /// # Errors
    /// Returns an error if the scene has no triangles or needs more elements than an item id can number.
    pub fn new(scene: &Scene, settings: &MeshSettings) -> Result<Self, MeshError> {
        Self::refined(scene, settings, &mut Splits::default())
    }

    /// Cuts a scene, and also halves the edges of `splits`, which may be shorter than the element size. Further edges
    /// that must be halved to keep the mesh conforming are added to `splits`.
    ///
    /// # Errors
    /// Returns an error as [`Self::new`] does.
    pub fn refined(scene: &Scene, settings: &MeshSettings, splits: &mut Splits) -> Result<Self, MeshError> {
        let mut mesh = propagate::cut(scene, settings.element_size, splits)?;
        optics::evaluate(&mut mesh, scene);
        cluster::cluster(&mut mesh, scene, settings.patch_size);
        Ok(mesh)
    }
}
