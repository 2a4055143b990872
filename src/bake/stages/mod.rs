//! The stages of a bake, each a step of the recipe.
//!
//! [`VertexLighting`] refines the mesh by direct light and gathers indirect light, [`PatchSystem`] solves for the light
//! of the patches, [`FormFactorSources`] makes the form factors that both need, and [`lit_mesh`] carries the light of
//! vertices from stage to stage.

mod form_factor_sources;
mod lit_mesh;
mod patch_system;
mod vertex_gather;
mod vertex_lighting;

pub(super) use form_factor_sources::FormFactorSources;
pub(super) use patch_system::PatchSystem;
pub(super) use vertex_lighting::VertexLighting;
