//! The full matrix: all form factors between patches, solved by Gauss-Seidel iteration.
//!
//! This is the original radiosity method, for small scenes and as a reference for the other solvers. Memory and time
//! grow with the square of the number of patches. A sweep updates one unknown after the other from the newest values of
//! all others, which converges at least as fast as Jacobi iteration.
//!
//! Source: Goral, Torrance, Greenberg, Battaile 1984; Cohen, Greenberg 1985.

use glam::Vec3;
use rayon::prelude::*;
use thiserror::Error;

use super::row_store::RowStore;
use crate::base::ids::PatchId;
use crate::patch::PatchMesh;
use crate::radiosity::field::Field;

/// Largest size of a matrix, bytes.
const MAX_BYTES: usize = 1 << 30;

/// The system counts as solved if the largest relative change in a sweep is at most this.
const TOLERANCE: f32 = 1e-6;

/// Largest number of sweeps, equal to the limit of the slower Jacobi iteration.
const MAX_SWEEPS: usize = 1000;

/// The matrix is too large.
#[derive(Debug, Error)]
#[error(
    "a full matrix of {num_patches} patches takes {gib:.1} GiB, more than {max_gib} GiB; use the progressive solver",
    max_gib = MAX_BYTES >> 30
)]
pub struct MatrixTooLarge {
    /// Number of rows and of columns.
    pub num_patches: usize,
    /// Size of the matrix, GiB.
    pub gib: f64,
}

/// Checks that the matrix of `mesh` fits into memory.
///
/// # Errors
/// Returns an error if the matrix does not fit.
pub fn check_size(mesh: &PatchMesh) -> Result<(), MatrixTooLarge> {
    let num_patches = mesh.patches.len();
    let bytes = num_patches.saturating_mul(num_patches).saturating_mul(size_of::<Vec3>());
    if bytes > MAX_BYTES {
        return Err(MatrixTooLarge { num_patches, gib: bytes as f64 / (1u64 << 30) as f64 });
    }
    Ok(())
}

/// Solves for the indirect irradiance `[p][g]` on the patches; patches without a row stay dark. Also returns the
/// number of sweeps.
///
/// Equation: I_p = b_p + sum over q of K_pq I_q with b_p = sum over e of F_pe rho_e D_e and K_pq = sum over e in q of
/// F_pe rho_e.
#[must_use]
pub fn solve(mesh: &PatchMesh, direct: &Field, rows: &RowStore) -> (Field, usize) {
    let size = mesh.patches.len();
    // Assemble the matrix and the right side, row by row.
    let (matrix, right): (Vec<Vec<Vec3>>, Vec<Vec<Vec3>>) =
        (0..size).into_par_iter().map(|p| equation(mesh, direct, rows, PatchId::new(p))).unzip();
    let mut solution = Field::from_values(direct.num_groups(), right.concat());
    // Sweep over the unknowns, and compute each from the newest values of the others.
    for sweep in 1..=MAX_SWEEPS {
        let (mut change, mut brightest) = (0.0f32, f32::MIN_POSITIVE);
        for p in 0..size {
            for (g, &right) in right[p].iter().enumerate() {
                let others: Vec3 = matrix[p].iter().enumerate().map(|(q, &k)| k * solution.at(q)[g]).sum();
                let own = matrix[p][p];
                let value = (right + others - own * solution.at(p)[g]) / (Vec3::ONE - own);
                change = change.max((value - solution.at(p)[g]).abs().max_element());
                brightest = brightest.max(value.max_element());
                solution.at_mut(p)[g] = value;
            }
        }
        if change <= TOLERANCE * brightest {
            return (solution, sweep);
        }
    }
    (solution, MAX_SWEEPS)
}

/// Returns one row of the matrix `[p]`, and its right side `[g]`.
fn equation(mesh: &PatchMesh, direct: &Field, rows: &RowStore, patch: PatchId) -> (Vec<Vec3>, Vec<Vec3>) {
    let mut matrix = vec![Vec3::ZERO; mesh.patches.len()];
    let mut right = vec![Vec3::ZERO; direct.num_groups()];
    for entry in rows.get(patch).map_or(&[][..], |row| &row.entries) {
        let element = &mesh.elements[entry.element.index()];
        let reflected = entry.factor * element.reflectance;
        matrix[element.patch.index()] += reflected;
        for (sum, &direct) in right.iter_mut().zip(direct.at(entry.element.index())) {
            *sum += reflected * direct;
        }
    }
    (matrix, right)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::patch::MeshSettings;
    use crate::scene::builtin;

    #[test]
    fn a_matrix_that_does_not_fit_is_refused() {
        let scene = builtin::cornell();
        let settings = |size| MeshSettings { element_size: size, patch_size: size };
        let coarse = PatchMesh::new(&scene, &settings(0.5)).expect("a small mesh");
        assert!(check_size(&coarse).is_ok());
        let fine = PatchMesh::new(&scene, &settings(0.05)).expect("a large mesh");
        let error = check_size(&fine).expect_err("too many patches");
        assert!(error.to_string().contains("progressive"), "{error}");
    }
}
