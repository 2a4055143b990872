//! Pages of the side panel.

/// A page of the side panel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
pub enum Tab {
    /// What the picture shows.
    #[default]
    Picture,
    /// The bake.
    Solution,
    /// Measurements, and the view from a patch.
    Meter,
    /// Cameras, objects, files.
    Place,
}

/// The pages with their names and hints.
pub const TABS: [(Tab, &str, &str); 4] = [
    (Tab::Picture, "Picture", "View, light and shadows"),
    (Tab::Solution, "Solution", "Bake, time machine, advice"),
    (Tab::Meter, "Meter", "Lux, grids, view from a patch"),
    (Tab::Place, "Place", "Cameras, objects, output, files"),
];
