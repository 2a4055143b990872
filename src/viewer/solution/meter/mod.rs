//! The lux meter: readings at points, grids of points, and tables of both.
//!
//! Readings are computed by the function that `hemicube measure` calls. Only the shares of the light groups are
//! interpolated from the light at the vertices.

mod grid;
mod reading;
mod table;

pub use grid::{Grid, GridPlan};
pub use reading::{Reading, point_of, read};
pub use table::write_table;

#[cfg(test)]
mod tests;
