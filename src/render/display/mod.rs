//! Converts radiance to display colours: exposure, tone mapping, false colours.

pub mod cpu_tone_map;
pub mod false_colour;
pub mod light_meter;
pub mod tone_map;
