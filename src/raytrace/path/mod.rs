//! Rays through a lit scene: next-event estimation, connections with lights, chains of mirrors, whole paths.

pub(crate) mod connection;
pub(crate) mod light_sampling;
pub(crate) mod path_tracer;
pub(crate) mod ray_caster;
pub(crate) mod specular_chain;
