//! Settings of what is shown beside and over the picture: pages, wire, selection, located advice, moments of a recorded
//! bake.

use std::collections::BTreeSet;

use crate::base::ids::InstanceId;

/// Pages of the side panel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
pub enum Tab {
    /// Shading, light and shadows.
    #[default]
    Picture,
    /// The bake.
    Solution,
    /// Lux meter and patch view.
    Meter,
    /// Cameras, objects and files.
    Place,
}

/// The pages with their names and hints.
pub const TABS: [(Tab, &str, &str); 4] = [
    (Tab::Picture, "Picture", "View, light and shadows"),
    (Tab::Solution, "Solution", "Bake, time machine, advice"),
    (Tab::Meter, "Meter", "Lux, grids, view from a patch"),
    (Tab::Place, "Place", "Cameras, objects, output, files"),
];

/// Wireframe over the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
pub enum Wire {
    /// No wireframe.
    #[default]
    None,
    /// Edges of all elements.
    Elements,
    /// Edges between patches.
    Patches,
}

/// Instances that are hidden or selected.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    /// Instances that are not drawn. Their light and shadows stay as baked.
    pub hidden: BTreeSet<InstanceId>,
    /// The instance that is tinted in the picture.
    pub chosen: Option<InstanceId>,
    /// Filter of lists, which show only names that contain this text.
    pub filter: String,
}

/// One of the locations that a piece of advice is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AdviceLocation {
    /// Index of the advice.
    pub advice: usize,
    /// Index of its location.
    pub location: usize,
}

/// The moment of a recorded bake whose light is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ReplaySettings {
    /// True if the moment is shown instead of the finished light.
    pub is_on: bool,
    /// Index of the moment.
    pub moment: usize,
    /// True if the unshot light is added, spread evenly over the scene.
    pub with_ambient: bool,
}
