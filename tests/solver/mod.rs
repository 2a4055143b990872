//! The solution: mesh, form factors, solvers, final gather, cancelled and resumed bakes.

mod cancelled;
mod final_gather;
mod form_factors;
mod meshing;
mod noise;
mod radiosity;
