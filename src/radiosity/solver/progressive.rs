//! Progressive refinement: the patch with the greatest unshot power shoots, until little is left.
//!
//! Shooting is Southwell relaxation of the radiosity equation: each step takes the largest residual, here the unshot
//! power U_p of a patch, and distributes it to the elements e in view with the row of p alone:
//!
//! - irradiance: I_e += U_p F_pe / A_e
//! - the reflected share rho_e U_p F_pe joins the unshot power of e's own patch; U_p becomes 0.
//!
//! Patches shoot, elements receive. Direct light is already on the elements; its reflection is the first unshot power,
//! so all light shot here is indirect. Rows are kept within a budget of memory, so a patch that shoots again needs no
//! new hemicubes.
//!
//! Source: Cohen, Chen, Wallace, Greenberg 1988, "A progressive refinement approach to fast radiosity image
//! generation"; Gortler, Cohen, Slusallek 1994, "Radiosity and relaxation methods" (Southwell).

use std::time::Instant;

use glam::Vec3;

use super::row_store::RowStore;
use super::solution::{Energy, Solution};
use crate::base::colour::{LUMINANCE, luminance};
use crate::base::ids::PatchId;
use crate::base::progress::{Progress, Stage};
use crate::form_factor::{FormFactorError, FormFactorSource};
use crate::patch::PatchMesh;
use crate::radiosity::field::Field;
use crate::radiosity::viewpoints::Viewpoints;

/// When shooting ends, and how patches shoot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProgressiveSettings {
    /// Shooting ends when this share of the first unshot power is left.
    pub threshold: f32,
    /// Shooting ends after this many shots per patch on average.
    pub max_shots_a_patch: usize,
    /// Number of viewpoints per patch.
    pub points_a_patch: usize,
    /// Number of patches per step. Their rows are computed together.
    pub patches_a_batch: usize,
    /// Memory for kept rows, bytes.
    pub row_bytes: usize,
}

/// Refines the solution, shot by shot.
pub struct Progressive<'a> {
    mesh: &'a PatchMesh,
    viewpoints: Viewpoints,
    settings: ProgressiveSettings,
    solution: Solution,
    first_unshot: f64,
    rows: RowStore,
}

impl<'a> Progressive<'a> {
    /// Starts from direct irradiance `[e][g]` on the elements.
    #[must_use]
    pub fn new(mesh: &'a PatchMesh, viewpoints: Viewpoints, direct: Field, settings: ProgressiveSettings) -> Self {
        let num_groups = direct.num_groups();
        let mut unshot = Field::zero(mesh.patches.len(), num_groups);
        let mut energy = Energy::default();
        for (e, element) in mesh.elements.iter().enumerate() {
            for (sum, &irradiance) in unshot.at_mut(element.patch.index()).iter_mut().zip(direct.at(e)) {
                let arriving = irradiance * element.area;
                *sum += arriving * element.reflectance;
                energy.emitted += arriving.as_dvec3();
                energy.absorbed += (arriving * (Vec3::ONE - element.reflectance)).as_dvec3();
            }
        }
        let solution =
            Solution { direct, indirect: Field::zero(mesh.elements.len(), num_groups), unshot, energy, num_shots: 0 };
        let mut this = Self {
            mesh,
            viewpoints,
            settings,
            solution,
            first_unshot: 0.0,
            rows: RowStore::new(mesh.patches.len(), settings.points_a_patch, settings.row_bytes),
        };
        this.sum_unshot();
        this.first_unshot = this.unshot_power();
        this
    }

    /// The solution so far.
    #[must_use]
    pub fn solution(&self) -> &Solution {
        &self.solution
    }

    /// Ends the refinement: returns the solution and the rows that are kept.
    #[must_use]
    pub fn into_parts(self) -> (Solution, RowStore) {
        (self.solution, self.rows)
    }

    /// Returns the share of the first unshot power that is still unshot.
    #[must_use]
    pub fn unshot_share(&self) -> f64 {
        if self.first_unshot > 0.0 { self.unshot_power() / self.first_unshot } else { 0.0 }
    }

    /// Returns true if the unshot share is below the threshold, or the number of shots has reached its limit.
    #[must_use]
    pub fn is_done(&self) -> bool {
        self.unshot_share() <= f64::from(self.settings.threshold)
            || self.solution.num_shots >= self.settings.max_shots_a_patch * self.mesh.patches.len()
    }

    /// Shoots from one batch of patches, those with the greatest unshot power; does nothing if cancelled before all
    /// rows are computed. Returns the seconds that form factors took.
    ///
    /// # Errors
    /// Returns an error if the form factors cannot be computed.
    pub fn step(&mut self, source: &mut dyn FormFactorSource, progress: &dyn Progress) -> Result<f64, FormFactorError> {
        let shooters = self.greatest_unshot();
        let start = Instant::now();
        let is_complete = self.rows.compute(&shooters, self.mesh, &self.viewpoints, source, progress)?;
        let seconds = start.elapsed().as_secs_f64();
        if is_complete {
            for &patch in &shooters {
                self.shoot(patch);
            }
            self.rows.keep_within_budget(&shooters);
            self.sum_unshot();
            progress.report(Stage::Solve, self.done_share());
        }
        Ok(seconds)
    }

    /// Progress 0..1 on a logarithmic scale, because unshot power decreases by a constant factor per pass.
    fn done_share(&self) -> f32 {
        (self.unshot_share().max(1e-12).ln() / f64::from(self.settings.threshold).ln()).clamp(0.0, 1.0) as f32
    }

    /// Returns the patches with the greatest unshot power, greatest first.
    fn greatest_unshot(&self) -> Vec<PatchId> {
        let power = |p: &PatchId| luminance(self.solution.unshot.total(p.index()));
        let mut patches: Vec<PatchId> = (0..self.mesh.patches.len()).map(PatchId::new).collect();
        let count = self.settings.patches_a_batch.min(patches.len());
        let greater_first = |a: &PatchId, b: &PatchId| power(b).total_cmp(&power(a)).then(a.cmp(b));
        if count < patches.len() {
            patches.select_nth_unstable_by(count, greater_first);
            patches.truncate(count);
        }
        patches.sort_by(greater_first);
        patches.retain(|p| power(p) > 0.0);
        patches
    }

    /// Distributes the unshot power of a patch to the elements in its view.
    ///
    /// Equation: dI_e = U_p F_pe / A_e, and rho_e dI_e A_e joins the unshot power of e's own patch.
    fn shoot(&mut self, patch: PatchId) {
        let Some(row) = self.rows.get(patch) else { return };
        let Solution { indirect, unshot, energy, .. } = &mut self.solution;
        let power: Vec<Vec3> = unshot.at_mut(patch.index()).iter_mut().map(std::mem::take).collect();
        for entry in &row.entries {
            let element = &self.mesh.elements[entry.element.index()];
            let received = indirect.at_mut(entry.element.index());
            let reflected = unshot.at_mut(element.patch.index());
            for (g, &power) in power.iter().enumerate() {
                let arriving = power * entry.factor;
                received[g] += arriving / element.area;
                reflected[g] += arriving * element.reflectance;
                energy.absorbed += (arriving * (Vec3::ONE - element.reflectance)).as_dvec3();
            }
        }
        let total = power.iter().sum::<Vec3>();
        energy.absorbed += (total * row.back).as_dvec3();
        energy.escaped += (total * row.sky).as_dvec3();
        self.solution.num_shots += 1;
    }

    fn sum_unshot(&mut self) {
        let unshot = &self.solution.unshot;
        self.solution.energy.unshot = (0..unshot.num_places()).map(|p| unshot.total(p).as_dvec3()).sum();
    }

    fn unshot_power(&self) -> f64 {
        self.solution.energy.unshot.dot(LUMINANCE.as_dvec3())
    }
}
