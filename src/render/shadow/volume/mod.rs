//! Shadow volumes: the stencil counts in how many volumes each visible point is (Crow 1977; Heidmann 1991).
//!
//! A triangle throws a volume that is bounded by the triangle and by the planes through the light and its edges, and
//! extends to infinity. A point is in shadow if it is in a volume. This is the case if a path from outside all volumes
//! to the point enters more volumes than it leaves. [`hull`] builds the volumes of all casters from signed edge counts
//! (Kim, Kim and Turk 2008), and [`stencil`] holds the two ways to count them:
//!
//! * z-pass, here *depth-pass*: along the ray from the eye to the point. It needs no caps and fails if the near plane
//!   cuts a volume; [`volumes`] has a cure.
//! * z-fail, here *depth-fail*: along the ray from infinity to the point (Everitt and Kilgard 2002, "Practical and
//!   robust stenciled shadow volumes"). It needs caps and a projection without a far plane, and is right everywhere.

pub mod hull;
mod known_fault;
mod near_plane;
pub mod settings;
mod shadow_pass;
mod shadow_volume;
pub mod silhouette;
mod stencil;
mod volumes;

pub use hull::Counting;
pub use known_fault::{KnownFault, fault_of_counting};
pub use shadow_pass::VolumeShadows;
