//! Sections of the page Meter.

pub mod lux_meter;
pub mod patch_view;
