//! Floor 5: the whole job as one recipe.

mod certificate;
mod forecast;
mod last_gather;
pub mod measure;
mod method;
pub mod patch_view;
mod refinement;
mod report;
mod settings;
mod solve;
mod watch;

use thiserror::Error;

use crate::baked::BakedScene;
use crate::base::progress::Stage;
use crate::form_factor::FormFactorError;
use crate::form_factor::row_cache::RowCache;
use crate::gpu::Gpu;
use crate::patch::{MeshError, PatchMesh};
use crate::radiosity::Field;
use crate::radiosity::Viewpoints;
use crate::radiosity::adaptive_subdivision::AdaptiveSubdivision;
use crate::radiosity::direct::DirectLight;
use crate::radiosity::direct::direct_on_elements;
use crate::radiosity::gather::GatheredLight;
use crate::radiosity::reconstruction::{average, fill_hidden, vertex_light};
use crate::radiosity::solver::Solution;
use crate::radiosity::solver::full_matrix::MatrixTooLarge;
use crate::scene::Scene;
use crate::trace::Tracer;

pub use forecast::Forecast;
pub use report::{Flux, Memory, Report};
pub use settings::{BakeSettings, Method, Quality, Solver, UnknownName};
pub use watch::{Seconds, Watch};

use certificate::{Closure, largest_neighbour_step, peak_memory, reciprocity_residual};
use last_gather::LitVertices;
use method::Seer;
use refinement::Lighting;
use settings::PENUMBRA_RAYS_ON_ELEMENTS;
use solve::{Solved, Task};
use watch::Clock;

/// A finished (or cancelled) bake.
pub struct Bake {
    /// The elements with their light.
    pub baked: BakedScene,
    /// The certificate.
    pub report: Report,
    /// The mesh that its light lies on.
    pub mesh: PatchMesh,
}

/// A bake could not be done.
#[derive(Debug, Error)]
pub enum BakeError {
    /// The scene cannot be cut.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// No form factors.
    #[error(transparent)]
    FormFactor(#[from] FormFactorError),
    /// Hemicubes were asked for where nothing can draw them.
    #[error("hemicubes need a device that draws them; the hemisphere method needs none")]
    NoDevice,
    /// The full matrix is for small scenes.
    #[error(transparent)]
    Matrix(#[from] MatrixTooLarge),
    /// Nothing shines.
    #[error("the scene {0} has no light: no emissive material and no light of KHR_lights_punctual")]
    NoLight(String),
}

/// Bakes a scene: meshing, direct light, progressive refinement, vertex light.
///
/// Where the watch cancels, what is solved so far is returned, with the average of the elements in place of gathered light.
///
/// # Errors
/// The scene has no triangles or no light, would need too many elements, hemicubes are wanted without a `gpu`, or the device
/// failed.
pub fn bake(gpu: Option<&Gpu>, scene: &Scene, settings: &BakeSettings, watch: &dyn Watch) -> Result<Bake, BakeError> {
    bake_with_rows(gpu, scene, settings, None, watch)
}

/// As [`bake`], taking rows of form factors from `rows` where it has them, and keeping there those that are found: a bake
/// that was stopped goes on, and one with other colours looks at nothing twice.
///
/// # Errors
/// As [`bake`]; trouble with the cache costs time and not the bake.
pub fn bake_with_rows(
    gpu: Option<&Gpu>,
    scene: &Scene,
    settings: &BakeSettings,
    rows: Option<&RowCache>,
    watch: &dyn Watch,
) -> Result<Bake, BakeError> {
    if scene.light_groups.is_empty() {
        return Err(BakeError::NoLight(scene.name.clone()));
    }
    let method = settings.method.unwrap_or_else(|| Method::fastest(gpu));
    let mut clock = Clock::start();

    // AdaptiveSubdivision the scene into elements and patches.
    watch.report(Stage::Mesh, 0.0);
    let sizes = settings.mesh_settings(scene);
    let (mut cut, mesh) = AdaptiveSubdivision::new(scene, sizes)?;
    let predicted = Forecast::of_mesh(scene, &mesh, settings, method).bytes as u64;
    log::info!("{} elements; about {} MiB of memory", mesh.elements.len(), predicted >> 20);
    watch.mesh(&BakedScene::of_mesh(scene, &mesh));
    clock.lap(Stage::Mesh);

    // Direct light at the vertices, to be shown, with more of them where it changes, and on the elements, to be sent on.
    let sites = Viewpoints::new(scene);
    let tracer = Tracer::new(scene);
    let lights = DirectLight::new(scene, &mesh, &tracer, settings.num_penumbra_rays);
    let lighting = Lighting::new(scene, &sizes, settings, &lights, &tracer, watch);
    let places = sites.at_light_vertices(&mesh);
    let (mesh, direct) = lighting.refine_by_direct(&mut cut, mesh, &places)?;
    if !watch.is_cancelled() {
        watch.mesh(&lit_mesh(scene, &mesh, &direct, &Field::zero(direct.num_places(), direct.num_groups())));
    }
    let few_rays = lights.with_rays(PENUMBRA_RAYS_ON_ELEMENTS);
    let on_elements = direct_on_elements(&mesh, &sites, &few_rays, settings.points_an_element, watch);
    clock.lap(Stage::Direct);

    // Carry on what the elements reflect, from patch to patch.
    let seer = Seer::new(method, gpu, &mesh, &tracer, rows)?;
    let show = |solution: &Solution| watch.light(&vertex_light(&mesh, &direct, &estimate(&mesh, solution)));
    let task = Task { mesh: &mesh, sites, seer, settings, watch, show: &show };
    let Solved { solution, rows, radiosity, num_passes, unshot_share, form_factor_seconds } =
        task.solve(on_elements)?;
    let (closure, reciprocity_residual) = (Closure::of(&mesh, &rows), reciprocity_residual(&mesh, &rows));
    let num_viewpoints = rows.num_viewpoints();
    drop(rows);
    clock.lap(Stage::Solve);

    // Collect the indirect light at the vertices, with more of them where it changes.
    let places = sites.at_light_vertices(&mesh);
    let lit = match radiosity {
        Some(radiosity) => lighting.gather(seer, &mut cut, &mesh, &places, direct, &radiosity)?,
        None => LitVertices::without_indirect(direct),
    };
    let (num_gathered, backface_share) = (lit.num_hemicubes, lit.backface_share);
    let hidden_vertices = lit.gathered.is_valid.iter().filter(|valid| !**valid).count();
    let (mesh, baked) = put_on_mesh(scene, mesh, lit, settings, |mesh| estimate(mesh, &solution));
    watch.mesh(&baked);
    clock.lap(Stage::Gather);

    let report = Report {
        scene: scene.name.clone(),
        quality: settings.quality,
        method,
        solver: settings.solver,
        adapter: gpu.map_or_else(|| "none".to_owned(), Gpu::name),
        input_triangles: scene.triangles.len(),
        elements: mesh.elements.len(),
        patches: mesh.patches.len(),
        vertices: mesh.light_vertices.len(),
        light_groups: scene.light_groups.clone(),
        hemicubes: num_viewpoints + num_gathered,
        hemicube_px: settings.hemicube_px,
        shots: solution.num_shots,
        passes: num_passes,
        unshot_share,
        cancelled: watch.is_cancelled(),
        energy: solution.energy.into(),
        closure,
        reciprocity_residual,
        largest_neighbour_step: largest_neighbour_step(&baked.scene, &baked.light),
        backface_share,
        hidden_vertices,
        seconds: Seconds { form_factors: form_factor_seconds, ..clock.seconds },
        memory_bytes: Memory { predicted, peak: peak_memory() },
    };
    Ok(Bake { baked, report, mesh })
}

/// The finished mesh with its light: vertices that were not gathered at have that of `estimate`, hidden ones that of those
/// beside them.
fn put_on_mesh(
    scene: &Scene,
    mesh: PatchMesh,
    lit: LitVertices,
    settings: &BakeSettings,
    estimate: impl Fn(&PatchMesh) -> Field,
) -> (PatchMesh, BakedScene) {
    let LitVertices { refined, mut direct, gathered, .. } = lit;
    let mut indirect = completed(&gathered, || estimate(&mesh));
    if settings.solver == Solver::Gathering && settings.passes == Some(0) {
        // Nothing has been reflected yet.
        direct = Field::zero(direct.num_places(), direct.num_groups());
    }
    let mesh = refined.unwrap_or(mesh);
    fill_hidden(&mesh, &gathered.is_valid, [&mut direct, &mut indirect]);
    let baked = lit_mesh(scene, &mesh, &direct, &indirect);
    (mesh, baked)
}

/// A mesh with light at its light vertices.
fn lit_mesh(scene: &Scene, mesh: &PatchMesh, direct: &Field, indirect: &Field) -> BakedScene {
    BakedScene { light: vertex_light(mesh, direct, indirect), ..BakedScene::of_mesh(scene, mesh) }
}

/// Indirect light at the vertices from an unfinished solution: averages plus the ambient estimate.
fn estimate(mesh: &PatchMesh, solution: &Solution) -> Field {
    let ambient = solution.ambient_estimate(mesh);
    let mut field = average(mesh, &solution.indirect);
    for groups in field.values_mut().chunks_exact_mut(ambient.len()) {
        for (value, &ambient) in groups.iter_mut().zip(&ambient) {
            *value += ambient;
        }
    }
    field
}

/// The gathered light, completed by the estimate where gathering was cut short.
fn completed(gathered: &GatheredLight, estimate: impl Fn() -> Field) -> Field {
    if gathered.is_known.iter().all(|known| *known) {
        return gathered.indirect.clone();
    }
    let mut field = estimate();
    for (place, _) in gathered.is_known.iter().enumerate().filter(|(_, known)| **known) {
        field.at_mut(place).copy_from_slice(gathered.indirect.at(place));
    }
    field
}
