//! The settings of a bake: presets, form-factor methods, solvers, and the numbers behind them.
//!
//! [`Quality`], [`Method`] and [`Solver`] have one table each (value, name, hint). The command line, the panels, the
//! benches and the report read it; no other place lists the values.

mod bake_settings;
mod choice;
mod method;
mod quality;
mod solver;

pub use bake_settings::{BakeSettings, MeshBudget, Refinement, Sampling};
pub use choice::UnknownName;
pub use method::Method;
pub use quality::Quality;
pub use solver::Solver;

pub(super) use bake_settings::{PENUMBRA_RAYS_ON_ELEMENTS, ROW_BYTES, SHOOTING_RAYS};
