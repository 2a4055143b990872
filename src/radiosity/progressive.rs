//! Progressive refinement: the patch with the greatest unshot power shoots, until little is left.
//!
//! Patches shoot, elements receive. Direct light is already on the elements; what they reflect of it is the first unshot
//! power, so that everything shot here is indirect light. Rows are kept as long as memory allows: a patch that shoots again
//! needs no new hemicubes.
//!
//! Source: Cohen, Chen, Wallace, Greenberg 1988, "A progressive refinement approach to fast radiosity image generation".

use std::time::Instant;

use glam::{DVec3, Vec3};

use super::field::Field;
use super::rows::RowStore;
use super::sites::Sites;
use crate::base::colour::luminance;
use crate::base::ids::PatchId;
use crate::base::progress::{Progress, Stage};
use crate::form_factor::{FormFactorError, FormFactorSource};
use crate::patch::{Element, PatchMesh};

/// How far to go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProgressiveSettings {
    /// Ends when this share of the first unshot power is left.
    pub threshold: f32,
    /// Ends after this many shots a patch on average.
    pub max_shots_a_patch: usize,
    /// Hemicubes spread over each patch.
    pub points_a_patch: usize,
    /// Patches that shoot together.
    pub patches_a_batch: usize,
    /// Bytes of rows to keep.
    pub row_bytes: usize,
}

/// The light on elements and what is still unshot.
#[derive(Clone, Debug)]
pub struct Solution {
    /// Direct irradiance `[e][g]`, lux per channel.
    pub direct: Field,
    /// Indirect irradiance `[e][g]`, lux per channel.
    pub indirect: Field,
    /// Unshot power `[p][g]`, lumen per channel.
    pub unshot: Field,
    /// Where the power went.
    pub energy: Energy,
    /// Patches that shot, repeats counted.
    pub num_shots: usize,
}

/// Power balance per channel, lumen: emitted = absorbed + unshot + escaped.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Arrived at surfaces straight from the lights.
    pub emitted: DVec3,
    /// Kept by surfaces, the black backs included.
    pub absorbed: DVec3,
    /// Still to be shot.
    pub unshot: DVec3,
    /// Left the scene after at least one reflection.
    pub escaped: DVec3,
}

impl Energy {
    /// The balance of a solution that was gathered: what it reflects is sent out once more, and what comes of that beyond it
    /// is unshot.
    #[must_use]
    pub fn of_gathered(mesh: &PatchMesh, direct: &Field, on_patches: &Field, rows: &RowStore) -> Self {
        let mut energy = Self::default();
        let mut reflected = vec![DVec3::ZERO; mesh.patches.len()];
        for (e, element) in mesh.elements.iter().enumerate() {
            let p = element.patch.index();
            let arriving = (direct.total(e) * element.area).as_dvec3();
            energy.emitted += arriving;
            energy.take(arriving, element);
            let whole = (direct.total(e) + on_patches.total(p)) * element.area;
            reflected[p] += (whole * element.reflectance).as_dvec3();
        }
        energy.unshot -= reflected.iter().sum::<DVec3>();
        for (p, &power) in reflected.iter().enumerate() {
            let Some(row) = rows.get(PatchId::new(p)) else {
                energy.unshot += power;
                continue;
            };
            for entry in &row.entries {
                energy.take(power * f64::from(entry.factor), &mesh.elements[entry.element.index()]);
            }
            energy.absorbed += power * f64::from(row.back);
            energy.escaped += power * f64::from(row.sky);
        }
        energy
    }

    /// Power that arrives at an element is absorbed or waits to be shot.
    fn take(&mut self, arriving: DVec3, element: &Element) {
        let reflectance = element.reflectance.as_dvec3();
        self.absorbed += arriving * (DVec3::ONE - reflectance);
        self.unshot += arriving * reflectance;
    }

    /// Share of the emitted power that is not accounted for, in the worst channel.
    #[must_use]
    pub fn imbalance(&self) -> f64 {
        let missing = (self.emitted - self.absorbed - self.unshot - self.escaped).abs();
        missing.max_element() / self.emitted.max_element().max(f64::MIN_POSITIVE)
    }
}

/// Refines the solution, shot by shot.
pub struct Progressive<'a> {
    mesh: &'a PatchMesh,
    sites: Sites,
    settings: ProgressiveSettings,
    solution: Solution,
    first_unshot: f64,
    rows: RowStore,
}

impl<'a> Progressive<'a> {
    /// Starts from direct irradiance `[e][g]` on the elements.
    #[must_use]
    pub fn new(mesh: &'a PatchMesh, sites: Sites, direct: Field, settings: ProgressiveSettings) -> Self {
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
            sites,
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

    /// The solution and the rows that led to it, and an end to refining it.
    #[must_use]
    pub fn into_parts(self) -> (Solution, RowStore) {
        (self.solution, self.rows)
    }

    /// Share of the first unshot power that is still unshot.
    #[must_use]
    pub fn unshot_share(&self) -> f64 {
        if self.first_unshot > 0.0 { self.unshot_power() / self.first_unshot } else { 0.0 }
    }

    /// Little enough is left, or the patches have shot as often as they may.
    #[must_use]
    pub fn is_done(&self) -> bool {
        self.unshot_share() <= f64::from(self.settings.threshold)
            || self.solution.num_shots >= self.settings.max_shots_a_patch * self.mesh.patches.len()
    }

    /// Lets one batch of patches shoot, unless it is cancelled before all rows are there; returns the seconds that form
    /// factors took.
    ///
    /// # Errors
    /// The form factors could not be found.
    pub fn step(&mut self, method: &mut dyn FormFactorSource, progress: &dyn Progress) -> Result<f64, FormFactorError> {
        let shooters = self.brightest();
        let start = Instant::now();
        let is_complete = self.rows.find(&shooters, self.mesh, &self.sites, method, progress)?;
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

    /// Progress on a logarithmic scale: unshot power falls by a constant factor a pass.
    fn done_share(&self) -> f32 {
        (self.unshot_share().max(1e-12).ln() / f64::from(self.settings.threshold).ln()).clamp(0.0, 1.0) as f32
    }

    /// The patches with the greatest unshot power, greatest first.
    fn brightest(&self) -> Vec<PatchId> {
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

    /// Sends the unshot power of a patch to the elements it sees.
    ///
    /// Equation: dE_e = U_p F_pe / A_e, and rho_e dE_e A_e joins the unshot power of e's own patch.
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
        self.solution.energy.unshot.dot(crate::base::colour::LUMINANCE.as_dvec3())
    }
}

impl Solution {
    /// Irradiance `[g]` that the unshot power would bring if it were spread evenly, all its reflections included: Cohen's
    /// ambient term, for the display of an unfinished solution.
    #[must_use]
    pub fn ambient_estimate(&self, mesh: &PatchMesh) -> Vec<Vec3> {
        let area: f32 = mesh.patches.iter().map(|patch| patch.area).sum();
        let reflected: Vec3 = mesh.elements.iter().map(|element| element.reflectance * element.area).sum();
        let interreflection = (Vec3::ONE - reflected / area.max(f32::MIN_POSITIVE)).recip();
        let num_groups = self.unshot.num_groups();
        let mut sums = vec![Vec3::ZERO; num_groups];
        for p in 0..self.unshot.num_places() {
            for (sum, &power) in sums.iter_mut().zip(self.unshot.at(p)) {
                *sum += power;
            }
        }
        sums.iter().map(|&power| power / area.max(f32::MIN_POSITIVE) * interreflection).collect()
    }
}
