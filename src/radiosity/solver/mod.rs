//! Three solvers of the system of patches: I_p = sum over elements e of F_pe rho_e (D_e + I of e's patch).
//!
//! All are relaxation methods for the same linear system, and all converge, because reflectances are below 1 (Cohen,
//! Wallace 1993, chapter 5; Gortler, Cohen, Slusallek 1994):
//!
//! | solver | method | a step |
//! |---|---|---|
//! | [`progressive`] refinement | Southwell's, in the form of shooting | the patch with the greatest unshot power (the largest residual) distributes it to all others |
//! | [`jacobi`] | Jacobi's: gathering | all patches gather from the values of the previous pass: one more reflection |
//! | [`full_matrix`] | Gauss-Seidel's | each patch gathers from the newest values of all others |
//!
//! Shooting needs only the rows of the patches that shoot, and a small share of all rows is enough for a good picture.
//! The other two solvers need all rows.

pub mod full_matrix;
pub mod jacobi;
pub mod progressive;
mod row_store;
mod solution;

pub use row_store::{PatchRow, RowStore};
pub use solution::{Energy, Solution};
