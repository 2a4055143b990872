//! Direct light: irradiance that arrives straight from the lights.

mod direct_irradiance;
mod element_irradiance;
mod emitter;

pub use direct_irradiance::DirectLight;
pub use element_irradiance::{direct_on_elements, is_inside_solid};
