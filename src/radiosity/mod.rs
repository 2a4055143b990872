//! Floor 4: the light itself.
//!
//! The route through this floor: [`sites`] says where irradiance is wanted, [`direct`] brings what comes straight from the
//! lights, [`adaptive`] subdivision halves elements where it is not linear, one of three solvers carries it on from patch to
//! patch ([`progressive`] refinement, [`gathering`] pass after pass, the [`full_matrix`]), [`gather`] collects the indirect
//! light at every site, looking more than once where [`noise`] asks for it, and [`reconstruct`] puts it on the mesh that is
//! drawn.

pub mod adaptive;
pub mod cache;
pub mod contacts;
pub mod direct;
pub mod element_light;
mod emitter;
pub mod field;
pub mod full_matrix;
pub mod gather;
pub mod gathering;
pub mod noise;
pub mod progressive;
pub mod reconstruct;
pub mod rows;
mod sight;
pub mod sites;

pub use field::Field;
