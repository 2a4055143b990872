//! Final gather: indirect irradiance at the vertices, from hemicubes or hemispheres over the solved elements.
//!
//! [`FinalGather`] places them at a sparse set of vertices, which the [`irradiance cache`](IrradianceCache) chooses; the
//! vertices between are interpolated. [`SamplingNoise`] decides how many one vertex needs, and [`NearField`] corrects the
//! light of elements close by.

mod final_gather;
mod irradiance_cache;
mod near_field;
mod plane_fit;
mod sampled_view;
mod sampling_noise;

pub use final_gather::{FinalGather, FinalGatherSettings, GatheredLight};
pub use irradiance_cache::IrradianceCache;
pub use near_field::{NearElement, NearField};
pub use sampling_noise::{SamplingNoise, irradiance_and_variance};
