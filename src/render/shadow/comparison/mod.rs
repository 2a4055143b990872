//! Compares shadow techniques: finds the pixels in which they disagree whether a light is visible.

mod decisions;
mod difference;
mod shadow_comparison;

pub use decisions::{Decisions, SampleDecisions};
pub use difference::{ShadowDifference, shadow_difference};
pub use shadow_comparison::{ComparedScene, ShadowComparison};
