//! A mesh with the light of its vertices.

use crate::baked::{BakedScene, VertexLight};
use crate::patch::PatchMesh;
use crate::radiosity::Field;
use crate::radiosity::reconstruction::{average, vertex_light};
use crate::radiosity::solver::Solution;
use crate::scene::Scene;

/// A mesh with the direct light of its light vertices.
pub(in crate::bake) struct LitMesh {
    pub mesh: PatchMesh,
    /// Direct irradiance `[l][g]`, lux per channel.
    pub direct: Field,
}

impl LitMesh {
    /// Returns the mesh as a scene with direct light alone.
    pub fn without_indirect(&self, scene: &Scene) -> BakedScene {
        self.with_indirect(scene, &Field::zero(self.direct.num_places(), self.direct.num_groups()))
    }

    /// Returns the mesh as a scene with direct light and `indirect` light `[l][g]`.
    pub fn with_indirect(&self, scene: &Scene, indirect: &Field) -> BakedScene {
        BakedScene { light: vertex_light(&self.mesh, &self.direct, indirect), ..BakedScene::of_mesh(scene, &self.mesh) }
    }

    /// Returns the light of an unfinished solution.
    pub fn estimate(&self, solution: &Solution) -> VertexLight {
        vertex_light(&self.mesh, &self.direct, &self.estimated_indirect(solution))
    }

    /// Returns the indirect light `[l][g]` of an unfinished solution: averages of the elements plus the ambient
    /// estimate.
    pub fn estimated_indirect(&self, solution: &Solution) -> Field {
        let ambient = solution.ambient_estimate(&self.mesh);
        let mut indirect = average(&self.mesh, &solution.indirect);
        for groups in indirect.values_mut().chunks_exact_mut(ambient.len()) {
            for (value, &ambient) in groups.iter_mut().zip(&ambient) {
                *value += ambient;
            }
        }
        indirect
    }
}
