//! Surfaces that rays hit: diffuse and specular scattering, normal maps.

pub(crate) mod hit;
pub(crate) mod normal_map;
pub(crate) mod specular;
