//! Photometry of luminaires: luminous intensity by direction, from the table of a photometric file.
//!
//! Source: ANSI/IES LM-63-2019 (type C photometry).

mod distribution;
mod lm63;

pub use distribution::{Photometry, Profile};
pub use lm63::parse;
