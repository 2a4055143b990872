//! Report of a bake: the certificate of its solution, counts, times and memory.

mod bake_report;
mod memory;
mod row_quality;
mod seconds;
mod vertex_steps;

pub use bake_report::{Certificate, Configuration, Flux, MeshCounts, Report, Work};
pub use memory::Memory;
pub use row_quality::Closure;
pub use seconds::Seconds;

pub(super) use memory::peak_memory;
pub(super) use row_quality::RowQuality;
pub(super) use seconds::StageClock;
pub(super) use vertex_steps::largest_neighbour_step;
