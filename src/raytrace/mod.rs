//! Floor 3: pictures and measurements by rays on the CPU.
//!
//! [`path_traced`] and [`irradiance()`] are the truth, by unbiased paths; [`two_pass()`] shows a bake with traced direct
//! light and mirrors. Units and conventions are those of radiosity: surfaces are single-sided unless their material says
//! otherwise, a back blocks light and is black, and diffuse light is sent on from the geometric surface. Deliberately
//! absent: the GPU, exposure and tone mapping (a picture here is linear radiance), light of punctual lights that a mirror
//! throws.

mod connection;
mod direct;
mod film;
mod gather;
mod irradiance;
mod light_bounds;
mod light_tree;
mod lights;
mod mirrors;
mod normal_map;
mod path;
mod photons;
mod sampler;
mod settings;
mod specular;
mod stored;
mod surface;
mod thrown;
mod two_pass;

pub use film::{Film, FilmNoise};
pub use gather::{GatherPrecision, gathered_irradiance, stored_irradiance};
pub use irradiance::{Irradiance, MeasuringPoint, irradiance};
pub use settings::{Ambient, PathSettings, TwoPassSettings};
pub use two_pass::{SecondPass, two_pass};

use crate::base::progress::Progress;
use crate::scene::Camera;
use crate::trace::Tracer;

/// A path-traced picture, unbiased; without a sample where it was cancelled.
#[must_use]
pub fn path_traced(
    tracer: &Tracer<'_>,
    camera: &Camera,
    size: [u32; 2],
    settings: &PathSettings,
    progress: &dyn Progress,
) -> Film {
    let paths = path::PathTracer::new(tracer, settings.max_bounces, settings.has_specular);
    let mut film = Film::new(size);
    film.refine(camera, settings.samples, settings.seed, progress, |ray, sampler| paths.seen(ray, sampler));
    film
}
