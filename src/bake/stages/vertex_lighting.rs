//! Light at vertices, and the subdivision of the mesh according to it.

use super::form_factor_sources::FormFactorSources;
use super::lit_mesh::LitMesh;
use super::vertex_gather::VertexGather;
use crate::bake::context::BakeObserver;
use crate::bake::error::BakeError;
use crate::bake::settings::BakeSettings;
use crate::base::colour::luminance;
use crate::form_factor::{FormFactorSource, Viewpoint};
use crate::patch::{MeshSettings, PatchMesh};
use crate::radiosity::adaptive_subdivision::{AdaptiveSubdivision, SampledLight, SubdivisionSettings};
use crate::radiosity::direct::{DirectLight, is_inside_solid};
use crate::radiosity::gather::{FinalGather, FinalGatherSettings, GatheredLight};
use crate::radiosity::{Field, Viewpoints};

/// Errors are relative to the luminance, but to no less than this share of the mean luminance over the vertices,
/// because errors in the dark are invisible.
const FLOOR: f32 = 0.05;

/// Samples the light of vertices and subdivides the mesh where it is not linear.
pub(in crate::bake) struct VertexLighting<'a> {
    lights: &'a DirectLight<'a>,
    settings: &'a BakeSettings,
    by_direct: SubdivisionSettings,
    by_all: SubdivisionSettings,
    gather: FinalGatherSettings,
    observer: &'a dyn BakeObserver,
}

impl<'a> VertexLighting<'a> {
    /// Creates the lighting of vertices with `settings`; `sizes` are those of the first mesh.
    pub fn new(
        lights: &'a DirectLight<'a>,
        settings: &'a BakeSettings,
        sizes: &MeshSettings,
        observer: &'a dyn BakeObserver,
    ) -> Self {
        let by_direct = settings.subdivision_by_direct(lights.tracer().scene(), sizes);
        let by_all = settings.subdivision_by_all(by_direct, sizes);
        Self { lights, settings, by_direct, by_all, gather: settings.final_gather(sizes), observer }
    }

    /// Subdivides a mesh until direct light is linear along its edges.
    pub fn refine_by_direct(
        &self,
        subdivision: &mut AdaptiveSubdivision<'_>,
        mesh: PatchMesh,
        viewpoints: &Viewpoints,
    ) -> Result<LitMesh, BakeError> {
        let sampled = self.direct(&viewpoints.at_light_vertices(&mesh));
        if !self.is_subdividing() {
            return Ok(LitMesh { mesh, direct: sampled.light });
        }
        let floor = FLOOR * mean_luminance(&sampled.light);
        let mut evaluate = |some: &[Viewpoint]| -> Result<SampledLight, BakeError> { Ok(self.direct(some)) };
        let (mesh, sampled) = subdivision.refine(mesh, sampled, &self.by_direct, floor, &mut evaluate)?;
        Ok(LitMesh { mesh, direct: sampled.light })
    }

    /// Gathers reflected `radiosity` `[e][g]` at the vertices of `lit`. Without radiosity it gathers nothing.
    pub fn gather(
        &self,
        sources: FormFactorSources<'_>,
        subdivision: &mut AdaptiveSubdivision<'_>,
        lit: &LitMesh,
        viewpoints: &Viewpoints,
        radiosity: Option<Field>,
    ) -> Result<VertexGather, BakeError> {
        let Some(radiosity) = radiosity else { return Ok(VertexGather::unknown(lit)) };
        let viewpoints = viewpoints.at_light_vertices(&lit.mesh);
        let mut source = sources.for_vertices(self.settings);
        let mut final_gather = FinalGather::new(&lit.mesh, &radiosity, self.gather);
        let mut gathered = final_gather.at(&mut *source, &viewpoints, self.observer)?;
        let mut refined = None;
        if !self.observer.is_cancelled() {
            // If the user limits the passes, the result must hold the light of that many reflections only. The
            // near-field correction would add light of further reflections.
            if self.settings.passes.is_none() {
                final_gather.correct_near_field(&viewpoints, &lit.direct, &mut gathered);
            }
            refined = self.refine_by_all(subdivision, lit, &gathered, &mut final_gather, &mut *source)?;
        }
        let (refined, gathered) = match refined {
            Some((refined, gathered)) => (Some(refined), gathered),
            None => (None, gathered),
        };
        let (num_hemicubes, backface_share) = (final_gather.num_hemicubes, final_gather.mean_back_share());
        Ok(VertexGather { refined, gathered, num_hemicubes, backface_share })
    }

    /// Subdivides a mesh until direct and indirect light are linear along its edges. Returns `None` if the settings
    /// request no subdivision, or after a cancel.
    fn refine_by_all(
        &self,
        subdivision: &mut AdaptiveSubdivision<'_>,
        lit: &LitMesh,
        gathered: &GatheredLight,
        final_gather: &mut FinalGather<'_>,
        source: &mut dyn FormFactorSource,
    ) -> Result<Option<(LitMesh, GatheredLight)>, BakeError> {
        if !self.is_subdividing() {
            return Ok(None);
        }
        let num_groups = lit.direct.num_groups();
        let sampled = joined(&lit.direct, gathered);
        let floor = FLOOR * mean_luminance(&sampled.light);
        let mut evaluate = |some: &[Viewpoint]| -> Result<SampledLight, BakeError> {
            let direct = self.lights.irradiance(some, self.observer);
            let mut sampled = joined(&direct, &final_gather.at(source, some, self.observer)?);
            if self.observer.is_cancelled() {
                // Samples after a cancel may be incomplete and must not halve edges.
                sampled.is_open.fill(false);
            }
            Ok(sampled)
        };
        let (mesh, sampled) = subdivision.refine(lit.mesh.clone(), sampled, &self.by_all, floor, &mut evaluate)?;
        if self.observer.is_cancelled() {
            // The light of the newest vertices is incomplete, but that of the previous mesh is complete.
            return Ok(None);
        }
        let part = |first: usize| {
            let columns = |l: usize| sampled.light.at(l)[first..first + num_groups].iter().copied();
            Field::from_values(num_groups, (0..sampled.is_open.len()).flat_map(columns).collect())
        };
        let (direct, indirect, is_known) = (part(0), part(num_groups), vec![true; sampled.is_open.len()]);
        Ok(Some((LitMesh { mesh, direct }, GatheredLight { indirect, is_valid: sampled.is_open, is_known })))
    }

    fn is_subdividing(&self) -> bool {
        self.settings.refinement.max_error > 0.0 && !self.observer.is_cancelled()
    }

    /// Samples direct light. Also tests which dark viewpoints lie inside a solid.
    fn direct(&self, viewpoints: &[Viewpoint]) -> SampledLight {
        let light = self.lights.irradiance(viewpoints, self.observer);
        // After a cancel, viewpoints may be dark only because they were not reached.
        let is_cancelled = self.observer.is_cancelled();
        let is_open = |l: usize| {
            !is_cancelled && (luminance(light.total(l)) > 0.0 || !is_inside_solid(self.lights.tracer(), &viewpoints[l]))
        };
        let is_open = (0..viewpoints.len()).map(is_open).collect();
        SampledLight { light, is_open }
    }
}

/// Joins direct and gathered light: the first half of the columns is direct, the second half indirect.
fn joined(direct: &Field, gathered: &GatheredLight) -> SampledLight {
    let columns = |l: usize| direct.at(l).iter().chain(gathered.indirect.at(l)).copied();
    let places = 0..gathered.is_valid.len();
    let light = Field::from_values(2 * direct.num_groups(), places.clone().flat_map(columns).collect());
    SampledLight { light, is_open: places.map(|l| gathered.is_valid[l] && gathered.is_known[l]).collect() }
}

fn mean_luminance(light: &Field) -> f32 {
    let num_places = light.num_places();
    (0..num_places).map(|l| luminance(light.total(l))).sum::<f32>() / num_places.max(1) as f32
}
