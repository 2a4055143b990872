//! Shadow maps: a point is lit if it is the nearest surface to the light in its direction (Williams 1978, "Casting
//! curved shadows on curved surfaces").
//!
//! [`shadow_map`] draws the depth of the casters, seen from the light, by the [`projection`] of the light. Maps stay in
//! a [`cache`] while neither light nor casters move. [`block_planes`] summarises each block of texels as one plane.
//! [`pcf`] looks points up: percentage-closer filtering (Reeves, Salesin and Cook 1987) against the plane of the
//! receiver.

pub mod bindings;
pub mod block_planes;
pub mod cache;
pub mod pcf;
pub mod projection;
pub mod settings;
pub mod shadow_map;
mod shadow_pass;

pub use shadow_pass::MapShadows;
