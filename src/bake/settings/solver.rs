//! The ways to solve the system of patches.

use super::choice::choice_table;

/// How the system of patches is solved. All solvers converge to the same answer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Solver {
    /// Progressive refinement: shooting, the greatest unshot power first.
    #[default]
    Progressive,
    /// Jacobi iteration: each pass of gathering adds one more reflection.
    Gathering,
    /// The full matrix by Gauss-Seidel iteration: small scenes only.
    Matrix,
}

choice_table! {
    Solver {
        Progressive: "progressive", "Shooting, the greatest unshot power first";
        Gathering: "gathering", "Gathering pass after pass";
        Matrix: "matrix", "The full matrix, for small scenes";
    }
}
