//! The recipe of a bake: mesh, direct light, indirect light of patches, indirect light of vertices.

use super::context::BakeContext;
use super::error::BakeError;
use super::forecast::Forecast;
use super::report::{Certificate, Configuration, Memory, MeshCounts, Report, RowQuality, StageClock, Work};
use super::report::{largest_neighbour_step, peak_memory};
use super::settings::{BakeSettings, Method, PENUMBRA_RAYS_ON_ELEMENTS};
use super::stages::{FormFactorSources, PatchSystem, VertexLighting};
use crate::baked::BakedScene;
use crate::base::progress::Stage;
use crate::patch::PatchMesh;
use crate::radiosity::Viewpoints;
use crate::radiosity::adaptive_subdivision::AdaptiveSubdivision;
use crate::radiosity::direct::{DirectLight, direct_on_elements};
use crate::radiosity::solver::Solution;
use crate::scene::Scene;
use crate::trace::Tracer;

/// A finished or cancelled bake.
pub struct Bake {
    /// The elements with their light.
    pub baked: BakedScene,
    /// Counts, balances and times.
    pub report: Report,
    /// The mesh that the light belongs to.
    pub mesh: PatchMesh,
}

/// Bakes a scene on the CPU.
///
/// ```
/// use hemicube::bake::{BakeSettings, Method, Quality, bake};
/// use hemicube::scene::builtin;
///
/// let settings = BakeSettings {
///     element_size: Some(0.5),
///     method: Some(Method::Hemisphere),
///     hemisphere_rays: 64,
///     ..BakeSettings::preset(Quality::Draft)
/// };
/// let bake = bake(&builtin::cornell(), &settings)?;
/// let light = &bake.baked.light.groups[0];
/// assert_eq!(light.direct.len(), bake.baked.scene.vertices.len());
/// println!("irradiance at the first vertex: {} lx per channel", light.direct[0] + light.indirect[0]);
/// # Ok::<(), hemicube::bake::BakeError>(())
/// ```
///
/// # Errors
/// Returns an error if the scene has no triangles or no light, or would need too many elements.
pub fn bake(scene: &Scene, settings: &BakeSettings) -> Result<Bake, BakeError> {
    bake_with(scene, settings, &BakeContext::default())
}

/// Bakes a scene with a device, stored rows of form factors, or an observer.
///
/// After a cancel it returns the solution so far, with averages of the elements in place of gathered light.
///
/// # Errors
/// Returns an error if the scene has no triangles or no light or would need too many elements, if hemicubes are
/// requested without a device, or if the device fails. A row cache that cannot be written is not an error; it only
/// costs time.
pub fn bake_with(scene: &Scene, settings: &BakeSettings, context: &BakeContext<'_>) -> Result<Bake, BakeError> {
    if scene.light_groups.is_empty() {
        return Err(BakeError::NoLight(scene.name.clone()));
    }
    let (observer, method) = (context.observer, settings.method.unwrap_or_else(|| Method::fastest(context.gpu)));
    let mut clock = StageClock::start();

    // 1. Subdivide the scene into elements and patches.
    observer.report(Stage::Mesh, 0.0);
    let sizes = settings.mesh_settings(scene);
    let (mut subdivision, mesh) = AdaptiveSubdivision::new(scene, sizes)?;
    let predicted = Forecast::of_mesh(scene, &mesh, settings, method).bytes as u64;
    log::info!("{} elements; about {} MiB of memory", mesh.elements.len(), predicted >> 20);
    observer.on_mesh(&BakedScene::of_mesh(scene, &mesh));
    clock.end_stage(Stage::Mesh);

    // 2. Compute direct light at the vertices for display, with more vertices where it changes. Compute it also on the
    // elements, because the solver distributes the light that they reflect.
    let viewpoints = Viewpoints::new(scene);
    let tracer = Tracer::new(scene);
    let lights = DirectLight::new(scene, &mesh, &tracer, settings.sampling.num_penumbra_rays);
    let lighting = VertexLighting::new(&lights, settings, &sizes, observer);
    let lit = lighting.refine_by_direct(&mut subdivision, mesh, &viewpoints)?;
    if !observer.is_cancelled() {
        observer.on_mesh(&lit.without_indirect(scene));
    }
    let few_rays = lights.with_rays(PENUMBRA_RAYS_ON_ELEMENTS);
    let num_points = settings.sampling.points_an_element;
    let on_elements = direct_on_elements(&lit.mesh, &viewpoints, &few_rays, num_points, observer);
    clock.end_stage(Stage::Direct);

    // 3. Solve for the indirect light of the patches.
    let sources = FormFactorSources::new(method, context, &lit.mesh, &tracer)?;
    let show = |solution: &Solution| observer.on_light(&lit.estimate(solution));
    let system = PatchSystem { mesh: &lit.mesh, viewpoints, sources, settings, observer, show: &show };
    let solved = system.solve(on_elements)?;
    let rows = RowQuality::of(&lit.mesh, &solved.rows);
    let num_row_viewpoints = solved.rows.num_viewpoints();
    drop(solved.rows);
    clock.end_stage(Stage::Solve);

    // 4. Gather the indirect light of the vertices, with more vertices where it changes.
    let gathered = lighting.gather(sources, &mut subdivision, &lit, &viewpoints, solved.radiosity)?;
    let (num_gathered, backface_share) = (gathered.num_hemicubes, gathered.backface_share);
    let hidden_vertices = gathered.num_hidden();
    let (mesh, baked) = gathered.put_on_mesh(scene, lit, &solved.solution, settings);
    observer.on_mesh(&baked);
    clock.end_stage(Stage::Gather);

    let report = Report {
        configuration: Configuration::new(scene, settings, method, context.gpu),
        mesh: MeshCounts::new(scene, &mesh),
        work: Work {
            hemicubes: num_row_viewpoints + num_gathered,
            hemicube_px: settings.hemicube_px,
            shots: solved.solution.num_shots,
            passes: solved.num_passes,
            unshot_share: solved.unshot_share,
            cancelled: observer.is_cancelled(),
        },
        energy: solved.solution.energy.into(),
        certificate: Certificate {
            closure: rows.closure,
            reciprocity_residual: rows.reciprocity_residual,
            largest_neighbour_step: largest_neighbour_step(&baked.scene, &baked.light),
            backface_share,
            hidden_vertices,
        },
        seconds: clock.finish(solved.form_factor_seconds),
        memory_bytes: Memory { predicted, peak: peak_memory() },
    };
    Ok(Bake { baked, report, mesh })
}
