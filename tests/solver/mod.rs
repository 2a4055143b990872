//! The solution: mesh, form factors, solvers, gathering, stopped and resumed bakes.

mod form_factors;
mod gathering;
mod meshing;
mod noise;
mod radiosity;
mod stopped;
