//! Gathering on the patches with kept rows: the cure for the proximity error of shooting.
//!
//! A shooter is one or a few points; an element close to it receives too much or too little. Seen from the receiver the
//! same row is exact in its neighbourhood, and sums to one in a closed room. So once shooting has brought the light near
//! its place, patches gather until the system B = E + rho F B holds for the rows as they are.
//!
//! Source: Goral, Torrance, Greenberg, Battaile 1984 (the system); Baum, Rushmeier, Winget 1989 (why shooting errs).

use glam::Vec3;
use rayon::prelude::*;

use super::field::Field;
use super::progressive::Solution;
use super::rows::RowStore;
use crate::base::ids::PatchId;
use crate::patch::PatchMesh;

/// Largest relative change of a patch's irradiance at which the system counts as solved.
const TOLERANCE: f32 = 1e-4;

/// The slowest room (reflectance 0.99) loses 1 % a pass.
const MAX_PASSES: usize = 1000;

/// Indirect irradiance on patches `[p][g]`: that of the solution where no row is kept, else the solution of the system.
#[must_use]
pub fn polish(mesh: &PatchMesh, solution: &Solution, rows: &RowStore) -> Field {
    let num_groups = solution.direct.num_groups();
    let mut on_patches = mean_over_patches(mesh, &solution.indirect);
    for _ in 0..MAX_PASSES {
        let radiosity = reflected_radiosity(mesh, &solution.direct, &on_patches);
        let next: Vec<Option<Vec<Vec3>>> = (0..mesh.patches.len())
            .into_par_iter()
            .map(|p| {
                let row = rows.get(PatchId::new(p))?;
                let mut sums = vec![Vec3::ZERO; num_groups];
                for entry in &row.entries {
                    for (sum, &value) in sums.iter_mut().zip(radiosity.at(entry.element.index())) {
                        *sum += entry.factor * value;
                    }
                }
                Some(sums)
            })
            .collect();
        let brightest = (0..mesh.patches.len()).map(|p| on_patches.total(p).max_element()).fold(0.0, f32::max);
        let mut change = 0.0f32;
        for (p, gathered) in next.into_iter().enumerate() {
            for (value, gathered) in on_patches.at_mut(p).iter_mut().zip(gathered.into_iter().flatten()) {
                change = change.max((gathered - *value).abs().max_element());
                *value = gathered;
            }
        }
        if change <= TOLERANCE * brightest {
            break;
        }
    }
    on_patches
}

/// Reflected radiosity `[e][g]` from direct irradiance on elements and indirect irradiance on patches. Emission is left out:
/// it is direct light.
#[must_use]
pub fn reflected_radiosity(mesh: &PatchMesh, direct: &Field, indirect_on_patches: &Field) -> Field {
    let mut radiosity = Field::zero(mesh.elements.len(), direct.num_groups());
    for (e, element) in mesh.elements.iter().enumerate() {
        let indirect = indirect_on_patches.at(element.patch.index());
        for ((value, &direct), &indirect) in radiosity.at_mut(e).iter_mut().zip(direct.at(e)).zip(indirect) {
            *value = element.reflectance * (direct + indirect);
        }
    }
    radiosity
}

/// Mean over each patch of a field on elements, weighted by area.
fn mean_over_patches(mesh: &PatchMesh, on_elements: &Field) -> Field {
    let mut mean = Field::zero(mesh.patches.len(), on_elements.num_groups());
    for (e, element) in mesh.elements.iter().enumerate() {
        let share = element.area / mesh.patches[element.patch.index()].area.max(f32::MIN_POSITIVE);
        for (sum, &value) in mean.at_mut(element.patch.index()).iter_mut().zip(on_elements.at(e)) {
            *sum += value * share;
        }
    }
    mean
}
