//! The system of patches, solved by progressive refinement, Jacobi iteration or the full matrix.

use std::time::Instant;

use glam::DVec3;

use super::form_factor_sources::FormFactorSources;
use crate::bake::context::BakeObserver;
use crate::bake::error::BakeError;
use crate::bake::settings::{BakeSettings, Solver};
use crate::base::colour::LUMINANCE;
use crate::base::ids::PatchId;
use crate::base::progress::Stage;
use crate::patch::{Element, PatchMesh};
use crate::radiosity::solver::RowStore;
use crate::radiosity::solver::full_matrix;
use crate::radiosity::solver::jacobi::{gather_pass, iterate_until_converged, mean_over_patches, reflected_radiosity};
use crate::radiosity::solver::progressive::Progressive;
use crate::radiosity::solver::{Energy, Solution};
use crate::radiosity::{Field, Viewpoints};

/// Number of patches whose rows are computed between two progress reports.
const PATCHES_A_BATCH: usize = 64;

/// Jacobi iteration ends when the relative change of a pass is at most this.
const CONVERGED: f32 = 1e-4;

/// The light that patches reflect.
pub(in crate::bake) struct PatchSolution {
    pub solution: Solution,
    pub rows: RowStore,
    /// Reflected radiosity `[e][g]` that vertices gather; `None` after a cancel, or if no reflection is requested.
    pub radiosity: Option<Field>,
    /// Shots per patch, Jacobi passes or Gauss-Seidel sweeps.
    pub num_passes: usize,
    /// Share of the first reflected power that is unshot.
    pub unshot_share: f64,
    /// Time spent on form factors, seconds.
    pub form_factor_seconds: f64,
}

/// The patches of a mesh, and the inputs of their solvers.
pub(in crate::bake) struct PatchSystem<'a> {
    pub mesh: &'a PatchMesh,
    pub viewpoints: Viewpoints,
    pub sources: FormFactorSources<'a>,
    pub settings: &'a BakeSettings,
    pub observer: &'a dyn BakeObserver,
    /// Passes the light so far to the observer.
    pub show: &'a dyn Fn(&Solution),
}

impl PatchSystem<'_> {
    /// Solves for the indirect light that follows from direct irradiance `[e][g]`; incomplete after a cancel.
    pub fn solve(&self, direct: Field) -> Result<PatchSolution, BakeError> {
        match self.settings.solver {
            Solver::Progressive => self.solve_progressively(direct),
            Solver::Gathering => self.solve_by_passes(direct),
            Solver::Matrix => self.solve_full_matrix(direct),
        }
    }

    /// Solves by progressive refinement, then by Jacobi iteration over the stored rows to remove the proximity error of
    /// shooting.
    fn solve_progressively(&self, direct: Field) -> Result<PatchSolution, BakeError> {
        let mut source = self.sources.for_patches();
        let mut solver = Progressive::new(self.mesh, self.viewpoints, direct, self.settings.progressive());
        let mut form_factor_seconds = 0.0;
        while !solver.is_done() && !self.observer.is_cancelled() {
            if self.observer.is_light_due() {
                (self.show)(solver.solution());
            }
            form_factor_seconds += solver.step(&mut *source, self.observer)?;
        }
        let unshot_share = solver.unshot_share();
        let (solution, rows) = solver.into_parts();
        let num_passes = solution.num_shots.div_ceil(self.mesh.patches.len());
        let radiosity = (!self.observer.is_cancelled()).then(|| {
            let start = mean_over_patches(self.mesh, &solution.indirect);
            let on_patches = iterate_until_converged(self.mesh, &solution.direct, &rows, start);
            reflected_radiosity(self.mesh, &solution.direct, &on_patches)
        });
        Ok(PatchSolution { solution, rows, radiosity, num_passes, unshot_share, form_factor_seconds })
    }

    /// Solves by Jacobi iteration, starting from darkness. The first pass is the direct light, and the last one is the
    /// gather of the vertices.
    fn solve_by_passes(&self, direct: Field) -> Result<PatchSolution, BakeError> {
        let (rows, form_factor_seconds) = self.all_rows()?;
        let mut on_patches = Field::zero(self.mesh.patches.len(), direct.num_groups());
        let last = self.settings.passes.unwrap_or(usize::MAX);
        let mut num_passes = 1;
        while num_passes + 1 < last && !self.observer.is_cancelled() {
            let change = gather_pass(self.mesh, &direct, &rows, &mut on_patches);
            num_passes += 1;
            if self.observer.is_light_due() {
                (self.show)(&self.solution(direct.clone(), &on_patches, &rows, num_passes));
            }
            if change <= CONVERGED {
                break;
            }
        }
        let has_reflection = last > 1 && !self.observer.is_cancelled();
        let radiosity = has_reflection.then(|| reflected_radiosity(self.mesh, &direct, &on_patches));
        num_passes += usize::from(has_reflection);
        let solution = self.solution(direct, &on_patches, &rows, num_passes);
        let unshot_share = unshot_share(self.mesh, &solution);
        Ok(PatchSolution { solution, rows, radiosity, num_passes, unshot_share, form_factor_seconds })
    }

    /// Solves the full matrix by Gauss-Seidel iteration.
    fn solve_full_matrix(&self, direct: Field) -> Result<PatchSolution, BakeError> {
        full_matrix::check_size(self.mesh)?;
        let (rows, form_factor_seconds) = self.all_rows()?;
        let (on_patches, num_passes) = full_matrix::solve(self.mesh, &direct, &rows);
        let radiosity = reflected_radiosity(self.mesh, &direct, &on_patches);
        let radiosity = (!self.observer.is_cancelled()).then_some(radiosity);
        let solution = self.solution(direct, &on_patches, &rows, num_passes);
        let unshot_share = unshot_share(self.mesh, &solution);
        Ok(PatchSolution { solution, rows, radiosity, num_passes, unshot_share, form_factor_seconds })
    }

    /// Computes the rows of all patches, and returns them with the seconds that they took.
    fn all_rows(&self) -> Result<(RowStore, f64), BakeError> {
        let start = Instant::now();
        let mut source = self.sources.for_patches();
        let mut rows = RowStore::new(self.mesh.patches.len(), self.settings.sampling.points_a_patch, usize::MAX);
        let patches: Vec<PatchId> = (0..self.mesh.patches.len()).map(PatchId::new).collect();
        for (batch, patches) in patches.chunks(PATCHES_A_BATCH).enumerate() {
            if !rows.compute(patches, self.mesh, &self.viewpoints, &mut *source, self.observer)? {
                break;
            }
            self.observer.report(Stage::Solve, (batch * PATCHES_A_BATCH) as f32 / self.mesh.patches.len() as f32);
        }
        Ok((rows, start.elapsed().as_secs_f64()))
    }

    /// Returns the solution of a gathering solver, with its energy balance.
    fn solution(&self, direct: Field, on_patches: &Field, rows: &RowStore, num_passes: usize) -> Solution {
        let energy = Energy::of_gathered(self.mesh, &direct, on_patches, rows);
        let patch_of = |e: usize| on_patches.at(self.mesh.elements[e].patch.index());
        let indirect = (0..self.mesh.elements.len()).flat_map(patch_of).copied().collect();
        let num_groups = direct.num_groups();
        Solution {
            direct,
            indirect: Field::from_values(num_groups, indirect),
            unshot: Field::zero(self.mesh.patches.len(), num_groups),
            energy,
            num_shots: num_passes * self.mesh.patches.len(),
        }
    }
}

/// Unshot power as a share of what direct light alone reflects.
fn unshot_share(mesh: &PatchMesh, solution: &Solution) -> f64 {
    let of_element =
        |(e, element): (usize, &Element)| (solution.direct.total(e) * element.reflectance * element.area).as_dvec3();
    let first: DVec3 = mesh.elements.iter().enumerate().map(of_element).sum();
    let luminance = |power: DVec3| power.dot(LUMINANCE.as_dvec3());
    if luminance(first) > 0.0 { luminance(solution.energy.unshot) / luminance(first) } else { 0.0 }
}
