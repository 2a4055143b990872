//! Surface pass: the radiance that leaves every visible point towards the eye.
//!
//! ```text
//! L = emission + rho * (ambient + 1 / pi * (direct * E_direct + indirect * E_indirect))
//! ```
//!
//! [`pass`] draws the scene with the pipelines of [`variant`] into the targets of [`targets`]. [`direct_source`] lists
//! the sources of direct light, each with a shader of its own.

pub mod direct_source;
pub mod pass;
mod recently_used;
pub mod targets;
pub mod variant;
