//! The last stage: indirect light at the vertices, with more vertices where it changes.

use super::lit_mesh::LitMesh;
use crate::bake::settings::{BakeSettings, Solver};
use crate::baked::BakedScene;
use crate::patch::PatchMesh;
use crate::radiosity::Field;
use crate::radiosity::gather::GatheredLight;
use crate::radiosity::reconstruction::fill_hidden;
use crate::radiosity::solver::Solution;
use crate::scene::Scene;

/// The indirect light of vertices.
pub(in crate::bake) struct VertexGather {
    /// The refined mesh that the light belongs to; `None` if the mesh is unchanged.
    pub refined: Option<LitMesh>,
    /// Indirect light `[l][g]`, as far as it is known.
    pub gathered: GatheredLight,
    /// Number of viewpoints that were gathered from.
    pub num_hemicubes: usize,
    /// Mean share of their views that shows the backs of surfaces.
    pub backface_share: f32,
}

impl VertexGather {
    /// Returns a gather without any known indirect light.
    pub fn unknown(lit: &LitMesh) -> Self {
        let gathered = GatheredLight::unknown(lit.direct.num_places(), lit.direct.num_groups());
        Self { refined: None, gathered, num_hemicubes: 0, backface_share: 0.0 }
    }

    /// Number of vertices inside or behind a solid.
    pub fn num_hidden(&self) -> usize {
        self.gathered.is_valid.iter().filter(|valid| !**valid).count()
    }

    /// Returns the final mesh with its light: the gathered light, or the estimate from `solution` at vertices without
    /// it. Hidden vertices take the light of their neighbours.
    pub fn put_on_mesh(
        self,
        scene: &Scene,
        lit: LitMesh,
        solution: &Solution,
        settings: &BakeSettings,
    ) -> (PatchMesh, BakedScene) {
        let mut indirect = self.completed(|| lit.estimated_indirect(solution));
        let mut lit = self.refined.unwrap_or(lit);
        if settings.solver == Solver::Gathering && settings.passes == Some(0) {
            // No light has been reflected or even received yet: the picture shows the lamps alone.
            lit.direct = Field::zero(lit.direct.num_places(), lit.direct.num_groups());
        }
        fill_hidden(&lit.mesh, &self.gathered.is_valid, [&mut lit.direct, &mut indirect]);
        let baked = lit.with_indirect(scene, &indirect);
        (lit.mesh, baked)
    }

    /// Returns the gathered light, completed by an estimate if the gather was cancelled.
    fn completed(&self, estimate: impl Fn() -> Field) -> Field {
        let GatheredLight { indirect, is_known, .. } = &self.gathered;
        if is_known.iter().all(|known| *known) {
            return indirect.clone();
        }
        let mut field = estimate();
        for (l, _) in is_known.iter().enumerate().filter(|(_, known)| **known) {
            field.at_mut(l).copy_from_slice(indirect.at(l));
        }
        field
    }
}
