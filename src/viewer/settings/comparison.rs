//! Comparison of the shadows of two techniques in one picture.

use crate::render::ShadowSettings;

/// The second shadows of a comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparedShadows {
    /// Technique and settings of the second shadows.
    pub settings: ShadowSettings,
    /// Layout of the comparison.
    pub layout: ComparisonLayout,
}

/// Layout of two shadow techniques in one picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ComparisonLayout {
    /// One technique to the left and one to the right of a divider.
    #[default]
    Split,
    /// A heat map of the pixels in which the techniques disagree.
    Difference,
}
