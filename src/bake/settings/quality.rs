//! Named presets.

use super::choice::choice_table;

/// A preset of all numbers of a bake.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quality {
    /// For a first look within seconds.
    Draft,
    /// For walking through.
    #[default]
    Medium,
    /// For measuring and pictures.
    High,
}

choice_table! {
    Quality {
        Draft: "draft", "A first look: coarse, in seconds";
        Medium: "medium", "For walking through";
        High: "high", "For measuring: fine shadows, takes its time";
    }
}
