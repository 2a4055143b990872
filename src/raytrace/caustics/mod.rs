//! Caustics: light that mirrors and panes cast on diffuse surfaces (specular-to-diffuse transport), which radiosity
//! lacks.

pub(crate) mod caustic_light;
pub(crate) mod photons;
