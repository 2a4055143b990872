//! The last stage: indirect light at the vertices, with more of them where it changes.

use super::BakeError;
use super::method::Seer;
use super::refinement::Lighting;
use crate::form_factor::Viewpoint;
use crate::patch::PatchMesh;
use crate::radiosity::Field;
use crate::radiosity::adaptive_subdivision::AdaptiveSubdivision;
use crate::radiosity::gather::{FinalGather, GatheredLight};

/// Vertices with their light.
pub(super) struct LitVertices {
    /// The mesh that they belong to; none where it is the one before.
    pub refined: Option<PatchMesh>,
    /// Direct light `[l][g]`.
    pub direct: Field,
    /// Indirect light `[l][g]`, as far as it was found.
    pub gathered: GatheredLight,
    /// Viewpoints that were gathered from.
    pub num_hemicubes: usize,
    /// Share of backs that they saw.
    pub backface_share: f32,
}

impl LitVertices {
    /// Only direct light is known.
    pub(super) fn without_indirect(direct: Field) -> Self {
        let gathered = GatheredLight::unknown(direct.num_places(), direct.num_groups());
        Self { refined: None, direct, gathered, num_hemicubes: 0, backface_share: 0.0 }
    }
}

impl Lighting<'_> {
    /// Gathers reflected `radiosity` `[e][g]` at the light vertices of `mesh`, whose viewpoints are `places`.
    pub(super) fn gather(
        &self,
        seer: Seer<'_>,
        cut: &mut AdaptiveSubdivision<'_>,
        mesh: &PatchMesh,
        places: &[Viewpoint],
        direct: Field,
        radiosity: &Field,
    ) -> Result<LitVertices, BakeError> {
        let mut method = seer.gathering(self.settings);
        let mut gatherer = FinalGather::new(mesh, radiosity, self.gather);
        let mut gathered = gatherer.at(&mut *method, places, self.watch)?;
        let mut refined = None;
        if !self.watch.is_cancelled() {
            // A pass that was asked for reflects what the one before found, and no more.
            if self.settings.passes.is_none() {
                gatherer.correct_near_field(places, &direct, &mut gathered);
            }
            refined = self.refine_by_all(cut, mesh, (&direct, &gathered), &mut gatherer, &mut *method)?;
        }
        let (refined, direct, gathered) = match refined {
            Some((mesh, direct, gathered)) => (Some(mesh), direct, gathered),
            None => (None, direct, gathered),
        };
        let (num_hemicubes, backface_share) = (gatherer.num_hemicubes, gatherer.mean_back_share());
        Ok(LitVertices { refined, direct, gathered, num_hemicubes, backface_share })
    }
}
