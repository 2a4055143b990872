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
//! Shooting needs the rows of the shooters only, and a good picture after a small share of them; the other two need all
//! rows.

pub mod full_matrix;
pub mod jacobi;
pub mod progressive;
mod row_store;
mod solution;

pub use row_store::{PatchRow, RowStore};
pub use solution::{Energy, Solution};
