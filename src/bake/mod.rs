//! Floor 5: the whole bake, from a scene to a scene with its light.
//!
//! [`bake`] is one recipe of four stages: mesh, direct light, indirect light of patches, indirect light of vertices.
//! Settings are passed in, a [`Report`] comes out, and a [`BakeObserver`] may follow and cancel.
//! [`measure`](fn@measure) computes the irradiance at points of a baked scene.

mod context;
mod error;
mod forecast;
mod measure;
pub mod patch_view;
mod recipe;
mod report;
mod settings;
mod stages;

pub use context::{BakeContext, BakeObserver};
pub use error::BakeError;
pub use forecast::Forecast;
pub use measure::{MeasureContext, MeasureSettings, Measured, look_up, measure, measure_with};
pub use recipe::{Bake, bake, bake_with};
pub use report::{Certificate, Closure, Configuration, Flux, Memory, MeshCounts, Report, Seconds, Work};
pub use settings::{BakeSettings, MeshBudget, Method, Quality, Refinement, Sampling, Solver, UnknownName};
