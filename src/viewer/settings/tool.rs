//! The effect of a click in the picture.

/// The effect of a click in the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Captures the mouse, which then turns the camera.
    #[default]
    Look,
    /// Measures the light at a point.
    Meter,
    /// Measures a grid of points over a flat surface.
    Grid,
    /// Shows the view from the patch that is clicked.
    PatchView,
    /// Selects an instance.
    Choose,
    /// Adds a plane that receives planar shadows, or removes it.
    Receiver,
    /// Adds an instance that casts planar shadows, or removes it.
    Caster,
}

/// The tools of the tool bar with their names and hints.
pub const TOOLS: [(Tool, &str, &str); 5] = [
    (Tool::Look, "Look", "A click captures the mouse for looking around (Esc)"),
    (Tool::Meter, "Measure", "A click measures the light at a point (M)"),
    (Tool::Grid, "Grid", "A click measures a whole flat surface (G)"),
    (Tool::PatchView, "View from", "A click shows the view from that patch (N)"),
    (Tool::Choose, "Select", "A click selects an object (L)"),
];

/// Layout of a measuring grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridSettings {
    /// Distance between neighbouring points, metres.
    pub spacing: f32,
    /// Height of the points above the surface, metres.
    pub height: f32,
}
