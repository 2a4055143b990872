//! Jacobi iteration: gathering pass after pass. Every patch gathers from the values of the previous pass:
//!
//! I_p <- sum over elements e of F_pe rho_e (D_e + I of e's patch)
//!
//! Started from I = 0, the k-th pass adds the light of the k-th reflection. This is the Neumann series of the radiosity
//! equation. Started from the result of progressive refinement, the iteration removes the proximity error of shooting.
//! A shooter is sampled at one or a few points, so an element close to it receives too much or too little. The row of a
//! receiver is exact near the receiver and sums to 1 in a closed room.
//!
//! Source: Goral, Torrance, Greenberg, Battaile 1984 (the system); Baum, Rushmeier, Winget 1989 (the proximity
//! assumption).

use glam::Vec3;
use rayon::prelude::*;

use super::row_store::RowStore;
use crate::base::ids::PatchId;
use crate::patch::PatchMesh;
use crate::radiosity::field::Field;

/// Largest relative change of a patch's irradiance in a pass at which the system counts as solved.
const TOLERANCE: f32 = 1e-4;

/// Largest number of passes: the slowest room, of reflectance 0.99, reduces its error by 1 % per pass.
const MAX_PASSES: usize = 1000;

/// One pass: replaces indirect irradiance `[p][g]` by what the patches gather from it and from direct irradiance
/// `[e][g]`. Patches whose row is not kept stay unchanged. Returns the largest change, relative to the brightest patch.
pub fn gather_pass(mesh: &PatchMesh, direct: &Field, rows: &RowStore, on_patches: &mut Field) -> f32 {
    let radiosity = reflected_radiosity(mesh, direct, on_patches);
    let next: Vec<Option<Vec<Vec3>>> = (0..mesh.patches.len())
        .into_par_iter()
        .map(|p| {
            let row = rows.get(PatchId::new(p))?;
            let mut sums = vec![Vec3::ZERO; direct.num_groups()];
            for entry in &row.entries {
                for (sum, &value) in sums.iter_mut().zip(radiosity.at(entry.element.index())) {
                    *sum += entry.factor * value;
                }
            }
            Some(sums)
        })
        .collect();
    let (mut change, mut brightest) = (0.0f32, f32::MIN_POSITIVE);
    for (p, gathered) in next.into_iter().enumerate() {
        brightest = brightest.max(on_patches.total(p).max_element());
        for (value, gathered) in on_patches.at_mut(p).iter_mut().zip(gathered.into_iter().flatten()) {
            change = change.max((gathered - *value).abs().max_element());
            *value = gathered;
        }
    }
    change / brightest
}

/// Gathers until the radiosity equation holds for the kept rows, starting from `on_patches` `[p][g]`.
#[must_use]
pub fn iterate_until_converged(mesh: &PatchMesh, direct: &Field, rows: &RowStore, mut on_patches: Field) -> Field {
    for _ in 0..MAX_PASSES {
        if gather_pass(mesh, direct, rows, &mut on_patches) <= TOLERANCE {
            break;
        }
    }
    on_patches
}

/// Reflected radiosity `[e][g]` from direct irradiance on elements and indirect irradiance on patches, without
/// emission, whose light is direct.
///
/// Equation: rho_e (D_e + I of e's patch).
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

/// The mean over each patch `[p][g]` of a field on elements, weighted by area.
#[must_use]
pub fn mean_over_patches(mesh: &PatchMesh, on_elements: &Field) -> Field {
    let mut mean = Field::zero(mesh.patches.len(), on_elements.num_groups());
    for (e, element) in mesh.elements.iter().enumerate() {
        let share = element.area / mesh.patches[element.patch.index()].area.max(f32::MIN_POSITIVE);
        for (sum, &value) in mean.at_mut(element.patch.index()).iter_mut().zip(on_elements.at(e)) {
            *sum += value * share;
        }
    }
    mean
}
