//! Floor 3: pictures and measurements by rays on the CPU.
//!
//! [`irradiance()`] measures the truth at points by unbiased paths. Units and conventions are those of radiosity: surfaces
//! are single-sided unless their material says otherwise, a back blocks light and is black, and light is sent on from the
//! geometric surface. Deliberately absent: the GPU, exposure and tone mapping (a picture here is linear radiance).

mod irradiance;
mod light_tree;
mod lights;
mod path;
mod sampler;
mod settings;
mod specular;
mod surface;

pub use irradiance::{Irradiance, MeasuringPoint, irradiance};
pub use settings::PathSettings;
