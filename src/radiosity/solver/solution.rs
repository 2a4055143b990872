//! The result of a solver: irradiance on elements, unshot power on patches, and where the power went.

use glam::{DVec3, Vec3};

use super::row_store::RowStore;
use crate::base::ids::PatchId;
use crate::patch::{Element, PatchMesh};
use crate::radiosity::field::Field;

/// Irradiance on elements and unshot power on patches.
#[derive(Clone, Debug)]
pub struct Solution {
    /// Direct irradiance `[e][g]`, lux per channel.
    pub direct: Field,
    /// Indirect irradiance `[e][g]`, lux per channel.
    pub indirect: Field,
    /// Unshot power `[p][g]`, lumen per channel.
    pub unshot: Field,
    /// The balance of powers.
    pub energy: Energy,
    /// Number of shots; a patch may shoot several times.
    pub num_shots: usize,
}

impl Solution {
    /// The ambient estimate `[g]`: the irradiance of the unshot power if it were spread evenly over all surfaces, with
    /// all its reflections. An unfinished solution is displayed with it.
    ///
    /// Equation: ambient = (sum of unshot power / A) x R with R = 1 + rho + rho^2 + ... = 1 / (1 - rho), where A is the
    /// total area and rho the mean reflectance by area.
    ///
    /// Source: Cohen, Chen, Wallace, Greenberg 1988 (the ambient term).
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

/// Power balance per channel, lumen: emitted = absorbed + unshot + escaped.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Power that arrived at surfaces straight from the lights.
    pub emitted: DVec3,
    /// Power absorbed by surfaces, black backs included.
    pub absorbed: DVec3,
    /// Power not yet shot.
    pub unshot: DVec3,
    /// Power that left the scene after at least one reflection.
    pub escaped: DVec3,
}

impl Energy {
    /// Returns the balance of a gathered solution. To compute it, the reflected power of the solution is shot once
    /// more. The power that direct light and this shot reflect, minus the reflected power of the solution, counts as
    /// unshot. It includes the reciprocity error of the rows.
    #[must_use]
    pub fn of_gathered(mesh: &PatchMesh, direct: &Field, on_patches: &Field, rows: &RowStore) -> Self {
        let mut energy = Self::default();
        let mut reflected = vec![DVec3::ZERO; mesh.patches.len()];
        for (e, element) in mesh.elements.iter().enumerate() {
            let p = element.patch.index();
            let arriving = (direct.total(e) * element.area).as_dvec3();
            energy.emitted += arriving;
            energy.receive(arriving, element);
            let incident = (direct.total(e) + on_patches.total(p)) * element.area;
            reflected[p] += (incident * element.reflectance).as_dvec3();
        }
        energy.unshot -= reflected.iter().sum::<DVec3>();
        for (p, &power) in reflected.iter().enumerate() {
            let Some(row) = rows.get(PatchId::new(p)) else {
                energy.unshot += power;
                continue;
            };
            for entry in &row.entries {
                energy.receive(power * f64::from(entry.factor), &mesh.elements[entry.element.index()]);
            }
            energy.absorbed += power * f64::from(row.back);
            energy.escaped += power * f64::from(row.sky);
        }
        energy
    }

    /// Splits power that arrives at an element into absorbed and unshot power.
    fn receive(&mut self, arriving: DVec3, element: &Element) {
        let reflectance = element.reflectance.as_dvec3();
        self.absorbed += arriving * (DVec3::ONE - reflectance);
        self.unshot += arriving * reflectance;
    }

    /// Share of the emitted power that is missing from the balance, in the worst channel.
    #[must_use]
    pub fn imbalance(&self) -> f64 {
        let missing = (self.emitted - self.absorbed - self.unshot - self.escaped).abs();
        missing.max_element() / self.emitted.max_element().max(f64::MIN_POSITIVE)
    }
}
