//! Compares shadow techniques: in which pixels they decide differently whether a light is visible.

mod decisions;
mod difference;
mod shadow_comparison;

pub use decisions::{Decisions, SampleDecisions};
pub use difference::{ShadowDifference, shadow_difference};
pub use shadow_comparison::{ComparedScene, ShadowComparison};
