//! Irradiance at given points: by path tracing, or from a bake.

pub(crate) mod from_bake;
pub(crate) mod path_traced;
pub(crate) mod point;
