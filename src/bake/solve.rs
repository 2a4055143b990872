//! The system of patches, by one of three solvers.

use std::time::Instant;

use super::BakeError;
use super::method::Seer;
use super::settings::{BakeSettings, Solver};
use super::watch::Watch;
use crate::base::ids::PatchId;
use crate::base::progress::Stage;
use crate::form_factor::FormFactorSource;
use crate::patch::PatchMesh;
use crate::radiosity::Field;
use crate::radiosity::Viewpoints;
use crate::radiosity::solver::RowStore;
use crate::radiosity::solver::full_matrix;
use crate::radiosity::solver::jacobi::{gather_pass, iterate_until_converged, mean_over_patches, reflected_radiosity};
use crate::radiosity::solver::progressive::Progressive;
use crate::radiosity::solver::{Energy, Solution};

/// Patches whose rows are found between two looks at the watch.
const PATCHES_A_BATCH: usize = 64;

/// Largest relative change of a gathering pass at which it is the last.
const SETTLED: f32 = 1e-4;

/// The light that patches send on.
pub(super) struct Solved {
    pub solution: Solution,
    pub rows: RowStore,
    /// Reflected radiosity `[e][g]`, from which vertices gather; none where they shall stay without indirect light.
    pub radiosity: Option<Field>,
    /// Shots a patch, gathering passes or sweeps.
    pub num_passes: usize,
    /// Share of the first reflected power that is not sent on.
    pub unshot_share: f64,
    /// Seconds that form factors took.
    pub form_factor_seconds: f64,
}

/// What a solver works on.
pub(super) struct Task<'a> {
    pub mesh: &'a PatchMesh,
    pub sites: Viewpoints,
    pub seer: Seer<'a>,
    pub settings: &'a BakeSettings,
    pub watch: &'a dyn Watch,
    /// Shows the light so far to the watch.
    pub show: &'a dyn Fn(&Solution),
}

impl Task<'_> {
    /// Solves for the light that direct irradiance `[e][g]` brings, or as much of it as was found before a cancel.
    pub(super) fn solve(&self, direct: Field) -> Result<Solved, BakeError> {
        match self.settings.solver {
            Solver::Progressive => self.shoot(direct),
            Solver::Gathering => self.gather(direct),
            Solver::Matrix => self.invert(direct),
        }
    }

    /// Progressive refinement, polished by gathering.
    fn shoot(&self, direct: Field) -> Result<Solved, BakeError> {
        let mut method = self.seer.shooting();
        let mut solver = Progressive::new(self.mesh, self.sites, direct, self.settings.progressive());
        let mut form_factor_seconds = 0.0;
        while !solver.is_done() && !self.watch.is_cancelled() {
            if self.watch.wants_light() {
                (self.show)(solver.solution());
            }
            form_factor_seconds += solver.step(&mut *method, self.watch)?;
        }
        let unshot_share = solver.unshot_share();
        let (solution, rows) = solver.into_parts();
        let num_passes = solution.num_shots.div_ceil(self.mesh.patches.len());
        let radiosity = (!self.watch.is_cancelled()).then(|| {
            let start = mean_over_patches(self.mesh, &solution.indirect);
            let on_patches = iterate_until_converged(self.mesh, &solution.direct, &rows, start);
            reflected_radiosity(self.mesh, &solution.direct, &on_patches)
        });
        Ok(Solved { solution, rows, radiosity, num_passes, unshot_share, form_factor_seconds })
    }

    /// Gathering pass by pass. The first pass is the direct light, and the last is done by the vertices.
    fn gather(&self, direct: Field) -> Result<Solved, BakeError> {
        let (rows, form_factor_seconds) = self.all_rows()?;
        let mut on_patches = Field::zero(self.mesh.patches.len(), direct.num_groups());
        let last = self.settings.passes.unwrap_or(usize::MAX);
        let mut num_passes = 1;
        while num_passes + 1 < last && !self.watch.is_cancelled() {
            let change = gather_pass(self.mesh, &direct, &rows, &mut on_patches);
            num_passes += 1;
            if self.watch.wants_light() {
                (self.show)(&self.solution(direct.clone(), &on_patches, &rows, num_passes));
            }
            if change <= SETTLED {
                break;
            }
        }
        let wants_indirect = last > 1 && !self.watch.is_cancelled();
        let radiosity = wants_indirect.then(|| reflected_radiosity(self.mesh, &direct, &on_patches));
        num_passes += usize::from(wants_indirect);
        let solution = self.solution(direct, &on_patches, &rows, num_passes);
        let unshot_share = unshot_share(self.mesh, &solution);
        Ok(Solved { solution, rows, radiosity, num_passes, unshot_share, form_factor_seconds })
    }

    /// The full matrix.
    fn invert(&self, direct: Field) -> Result<Solved, BakeError> {
        full_matrix::check_size(self.mesh)?;
        let (rows, form_factor_seconds) = self.all_rows()?;
        let (on_patches, num_passes) = full_matrix::solve(self.mesh, &direct, &rows);
        let radiosity = reflected_radiosity(self.mesh, &direct, &on_patches);
        let radiosity = (!self.watch.is_cancelled()).then_some(radiosity);
        let solution = self.solution(direct, &on_patches, &rows, num_passes);
        let unshot_share = unshot_share(self.mesh, &solution);
        Ok(Solved { solution, rows, radiosity, num_passes, unshot_share, form_factor_seconds })
    }

    /// The rows of all patches, and the seconds they took.
    fn all_rows(&self) -> Result<(RowStore, f64), BakeError> {
        let start = Instant::now();
        let mut method: Box<dyn FormFactorSource> = self.seer.shooting();
        let mut rows = RowStore::new(self.mesh.patches.len(), self.settings.points_a_patch, usize::MAX);
        let patches: Vec<PatchId> = (0..self.mesh.patches.len()).map(PatchId::new).collect();
        for (batch, patches) in patches.chunks(PATCHES_A_BATCH).enumerate() {
            if !rows.compute(patches, self.mesh, &self.sites, &mut *method, self.watch)? {
                break;
            }
            self.watch.report(Stage::Solve, (batch * PATCHES_A_BATCH) as f32 / self.mesh.patches.len() as f32);
        }
        Ok((rows, start.elapsed().as_secs_f64()))
    }

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
    let of_element = |(e, element): (usize, &crate::patch::Element)| {
        (solution.direct.total(e) * element.reflectance * element.area).as_dvec3()
    };
    let first: glam::DVec3 = mesh.elements.iter().enumerate().map(of_element).sum();
    let luminance = |power: glam::DVec3| power.dot(crate::base::colour::LUMINANCE.as_dvec3());
    if luminance(first) > 0.0 { luminance(solution.energy.unshot) / luminance(first) } else { 0.0 }
}
