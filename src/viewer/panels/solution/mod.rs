//! Sections of the page Solution.

pub mod advice;
pub mod bake;
mod certificate;
pub mod time_machine;
