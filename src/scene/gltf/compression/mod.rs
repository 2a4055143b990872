//! Compressed geometry: buffer views by meshoptimizer, primitives by Draco.

pub(super) mod draco;
pub(super) mod meshopt;
