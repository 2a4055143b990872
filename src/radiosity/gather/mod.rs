//! Final gather: indirect irradiance at the vertices, from hemicubes or hemispheres over the solved elements.
//!
//! [`FinalGather`] places them at a sparse set of vertices, which the irradiance cache chooses. Other vertices are
//! interpolated. The sampling noise around a vertex decides how many hemicubes it needs. The near-field correction
//! adjusts the light of elements close by.

mod final_gather;
mod irradiance_cache;
mod near_field;
mod plane_fit;
mod sampled_view;
mod sampling_noise;

pub use final_gather::{FinalGather, FinalGatherSettings, GatheredLight};
pub use sampling_noise::irradiance_and_variance;
