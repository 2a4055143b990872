//! Gathering on the patches, pass after pass: the k-th pass brings the light of the k-th reflection.
//!
//! Each pass every patch collects what all others reflect. From the dark that is the classic series of pictures; from the
//! answer of progressive refinement it is the cure for the proximity error of shooting: a shooter is one or a few points,
//! and an element close to it receives too much or too little, whereas the same row seen from the receiver is exact in its
//! neighbourhood and sums to one in a closed room.
//!
//! Source: Goral, Torrance, Greenberg, Battaile 1984 (the system); Baum, Rushmeier, Winget 1989 (why shooting errs).

use glam::Vec3;
use rayon::prelude::*;

use super::field::Field;
use super::rows::RowStore;
use crate::base::ids::PatchId;
use crate::patch::PatchMesh;

/// Largest relative change of a patch's irradiance at which the system counts as solved.
const TOLERANCE: f32 = 1e-4;

/// The slowest room (reflectance 0.99) loses 1 % a pass.
const MAX_PASSES: usize = 1000;

/// One pass: indirect irradiance `[p][g]` becomes what the patches gather from it and from the direct light on elements;
/// patches whose row is not kept stay as they are. Returns the largest change, relative to the brightest patch.
///
/// Equation: I_p = sum over elements of F_pe rho_e (D_e + I of e's patch).
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

/// Gathers until the system B = E + rho F B holds for the rows as they are, beginning with `on_patches` `[p][g]`.
#[must_use]
pub fn polish(mesh: &PatchMesh, direct: &Field, rows: &RowStore, mut on_patches: Field) -> Field {
    for _ in 0..MAX_PASSES {
        if gather_pass(mesh, direct, rows, &mut on_patches) <= TOLERANCE {
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
