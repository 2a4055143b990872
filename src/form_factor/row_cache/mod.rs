//! Rows of form factors stored in a file. They are read back if a bake was stopped, or if lamps or colours have
//! changed.
//!
//! A row is identified by a fingerprint of its inputs: the elements, the method and the viewpoint. Light and
//! reflectance are not among them. The file is a header followed by records in the order of writing, so a stopped run
//! leaves whole records and at most one broken record at the end.

mod cache;
mod record;
mod source;

pub use cache::{RowCache, RowCacheError};
pub use source::CachedFormFactors;
