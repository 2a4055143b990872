//! Floor 3: pictures and measurements by rays on the CPU.
//!
//! [`path_traced`] and [`irradiance()`] are unbiased estimates by path tracing, the reference for all other methods;
//! [`two_pass()`] shows a bake with traced direct light and mirrors. Units and conventions are those of radiosity: a
//! surface is single-sided unless its material says otherwise, a back blocks light and is black, and diffuse light
//! leaves the geometric surface. Pictures are linear radiance. Deliberately absent: the GPU, exposure and tone mapping,
//! light of punctual lights by way of mirrors.
//!
//! * `ray`, `sampler`, `settings`: types used by all other modules.
//! * `surface/`: the surface at a hit, and how light scatters there.
//! * `light/`: lamps and punctual lights, and how one of many is chosen.
//! * `path/`: rays through the lit scene, and path tracing.
//! * `caustics/`: the light that a bake lacks because it is cast by mirrors and panes.
//! * `point_irradiance/`: irradiance at points, traced or from a bake.
//! * `film`, `two_pass`: pictures.

mod caustics;
mod film;
mod light;
mod path;
mod point_irradiance;
mod ray;
mod sampler;
mod settings;
mod stored_light;
mod surface;
mod two_pass;

pub use film::{Film, FilmNoise};
pub use path::path_tracer::path_traced;
pub use point_irradiance::from_bake::{GatherPrecision, gathered_irradiance, stored_irradiance};
pub use point_irradiance::path_traced::{Irradiance, irradiance};
pub use point_irradiance::point::MeasuringPoint;
pub use settings::{Ambient, PathSettings, TwoPassSettings};
pub use two_pass::{SecondPass, two_pass};
