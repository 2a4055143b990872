//! Sections of the page Place, and the dialog that opens a file.

pub mod cameras;
pub mod objects;
pub mod open;
pub mod output;
pub mod statistics;
