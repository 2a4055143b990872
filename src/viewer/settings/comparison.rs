//! Comparison of the shadows of two techniques in one picture.

use crate::render::ShadowSettings;

/// Shadows that those of the picture are compared with.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparedShadows {
    /// How they are computed.
    pub settings: ShadowSettings,
    /// How the two are laid out.
    pub layout: ComparisonLayout,
}

/// How two shadow techniques are shown in one picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ComparisonLayout {
    /// One left and one right of a divider.
    #[default]
    Split,
    /// A heat map of the pixels in which they disagree.
    Difference,
}
