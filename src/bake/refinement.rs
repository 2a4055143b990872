//! Light at vertices, and the mesh that follows it.

use super::watch::Watch;
use super::{BakeError, BakeSettings};
use crate::base::colour::luminance;
use crate::form_factor::{FormFactorSource, Viewpoint};
use crate::patch::{MeshSettings, PatchMesh};
use crate::radiosity::Field;
use crate::radiosity::adaptive_subdivision::{AdaptiveSubdivision, SampledLight, SubdivisionSettings};
use crate::radiosity::direct::DirectLight;
use crate::radiosity::direct::is_inside_solid;
use crate::radiosity::gather::{FinalGather, FinalGatherSettings, GatheredLight};
use crate::scene::Scene;
use crate::trace::Tracer;

/// Light that errors are measured beside even in the dark, as a share of the mean over the vertices.
const FLOOR: f32 = 0.05;

/// What refining asks for light.
pub(super) struct Lighting<'a> {
    lights: &'a DirectLight<'a>,
    tracer: &'a Tracer<'a>,
    pub settings: &'a BakeSettings,
    refine: SubdivisionSettings,
    sharpen: SubdivisionSettings,
    pub gather: FinalGatherSettings,
    pub watch: &'a dyn Watch,
}

impl<'a> Lighting<'a> {
    /// Refines and gathers as the settings want it on this scene.
    pub(super) fn new(
        scene: &Scene,
        sizes: &MeshSettings,
        settings: &'a BakeSettings,
        lights: &'a DirectLight<'a>,
        tracer: &'a Tracer<'a>,
        watch: &'a dyn Watch,
    ) -> Self {
        let refine = settings.refine(scene, sizes);
        let (sharpen, gather) = (settings.sharpen(refine, sizes), settings.gather(sizes));
        Self { lights, tracer, settings, refine, sharpen, gather, watch }
    }

    /// Refines a mesh until direct light is linear along its edges; returns it with the direct light `[l][g]`.
    pub(super) fn refine_by_direct(
        &self,
        cut: &mut AdaptiveSubdivision<'_>,
        mesh: PatchMesh,
        places: &[Viewpoint],
    ) -> Result<(PatchMesh, Field), BakeError> {
        let lit = self.direct(places);
        if !self.is_wanted() {
            return Ok((mesh, lit.light));
        }
        let floor = FLOOR * mean_luminance(&lit.light);
        let mut evaluate = |places: &[Viewpoint]| -> Result<SampledLight, BakeError> { Ok(self.direct(places)) };
        let (mesh, lit) = cut.refine(mesh, lit, &self.refine, floor, &mut evaluate)?;
        Ok((mesh, lit.light))
    }

    /// Refines a mesh with its `direct` and `gathered` light on until all of it is linear along its edges; none where that is
    /// not wanted, or no longer.
    pub(super) fn refine_by_all(
        &self,
        cut: &mut AdaptiveSubdivision<'_>,
        mesh: &PatchMesh,
        (direct, gathered): (&Field, &GatheredLight),
        gatherer: &mut FinalGather<'_>,
        method: &mut dyn FormFactorSource,
    ) -> Result<Option<(PatchMesh, Field, GatheredLight)>, BakeError> {
        if !self.is_wanted() {
            return Ok(None);
        }
        let num_groups = direct.num_groups();
        let is_known = |gathered: &GatheredLight, l: usize| gathered.is_valid[l] && gathered.is_known[l];
        let join = |direct: &Field, gathered: &GatheredLight| {
            let columns = |l: usize| direct.at(l).iter().chain(gathered.indirect.at(l)).copied();
            let places = 0..gathered.is_valid.len();
            let light = Field::from_values(2 * num_groups, places.clone().flat_map(columns).collect());
            SampledLight { light, is_open: places.map(|l| is_known(gathered, l)).collect() }
        };
        let lit = join(direct, gathered);
        let floor = FLOOR * mean_luminance(&lit.light);
        let mut evaluate = |places: &[Viewpoint]| -> Result<SampledLight, BakeError> {
            let direct = self.lights.irradiance(places, self.watch);
            let mut lit = join(&direct, &gatherer.at(method, places, self.watch)?);
            if self.watch.is_cancelled() {
                // Nothing is known for certain any more: no edge shall be halved for it.
                lit.is_open.fill(false);
            }
            Ok(lit)
        };
        let (mesh, lit) = cut.refine(mesh.clone(), lit, &self.sharpen, floor, &mut evaluate)?;
        if self.watch.is_cancelled() {
            // The light of the newest vertices was not found; the mesh as it was has all of its own.
            return Ok(None);
        }
        let part = |first: usize| {
            let columns = |l: usize| lit.light.at(l)[first..first + num_groups].iter().copied();
            Field::from_values(num_groups, (0..lit.is_open.len()).flat_map(columns).collect())
        };
        let (direct, indirect, is_known) = (part(0), part(num_groups), vec![true; lit.is_open.len()]);
        Ok(Some((mesh, direct, GatheredLight { indirect, is_valid: lit.is_open, is_known })))
    }

    fn is_wanted(&self) -> bool {
        self.settings.refine_error > 0.0 && !self.watch.is_cancelled()
    }

    /// Direct light; where it is dark, whether the place lies inside something.
    fn direct(&self, places: &[Viewpoint]) -> SampledLight {
        let light = self.lights.irradiance(places, self.watch);
        // Places that were not reached when cancelled are dark for no reason.
        let is_cancelled = self.watch.is_cancelled();
        let is_open =
            |l: usize| !is_cancelled && (luminance(light.total(l)) > 0.0 || !is_inside_solid(self.tracer, &places[l]));
        let is_open = (0..places.len()).map(is_open).collect();
        SampledLight { light, is_open }
    }
}

fn mean_luminance(light: &Field) -> f32 {
    let num_places = light.num_places();
    (0..num_places).map(|l| luminance(light.total(l))).sum::<f32>() / num_places.max(1) as f32
}
