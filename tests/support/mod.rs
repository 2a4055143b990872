//! What tests of pictures share.

pub mod device;
pub mod quads;
pub mod snapshot;
