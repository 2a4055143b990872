//! Floor 4: the light itself. Solves the radiosity equation on the patches and reconstructs irradiance at the vertices.
//!
//! The radiosity equation for diffuse surfaces, one unknown B per patch and colour channel:
//!
//! B_i = E_i + rho_i * sum over j of F_ij B_j
//!
//! with exitance E, reflectance rho and form factors F. All values here are irradiance rather than radiosity, and
//! direct irradiance D (straight from the lights) is kept apart from indirect irradiance I, so that B_i = E_i + rho_i
//! (D_i + I_i) and I_i = sum over j of F_ij rho_j (D_j + I_j): the system of the solvers. Patches p shoot, elements e
//! receive, light vertices l carry the result, light groups g are solved side by side.
//!
//! | step | room | what |
//! |---|---|---|
//! | where | [`Viewpoints`] | points slightly above patches, elements and vertices |
//! | direct light | [`direct`] | exact formulas and visibility rays |
//! | finer elements | [`adaptive_subdivision`] | edges are halved where light is not linear |
//! | indirect light of patches | [`solver`] | progressive refinement, Jacobi iteration or full matrix, on stored rows |
//! | indirect light of vertices | [`gather`] | final gather with an irradiance cache |
//! | result | [`reconstruction`] | from light vertices to the mesh that is drawn |
//!
//! Sources: Goral, Torrance, Greenberg, Battaile 1984, "Modeling the interaction of light between diffuse surfaces";
//! Cohen, Wallace 1993, "Radiosity and Realistic Image Synthesis".

pub mod adaptive_subdivision;
pub mod direct;
mod field;
pub mod gather;
pub mod reconstruction;
pub mod solver;
mod viewpoints;

pub use field::Field;
pub use viewpoints::Viewpoints;
