//! Planar shadows: casters projected on to a few large planes (Blinn 1988, "Me and my (fake) shadow").
//!
//! [`receivers`] chooses the planes, [`flattening`] projects the casters on to them, and [`planar_shadow`] marks the
//! result in the stencil. Surfaces outside these planes receive no shadows.

mod flattening;
mod planar_shadow;
pub mod planes;
pub mod receivers;
pub mod settings;
mod shadow_pass;

pub use shadow_pass::PlanarShadows;
