//! What a click in the picture does.

/// What a click in the picture does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Captures the mouse to look around.
    #[default]
    Look,
    /// Measures the light at a point.
    Meter,
    /// Measures a grid over a flat surface.
    Grid,
    /// Shows the view from a patch.
    PatchView,
    /// Selects an instance.
    Choose,
    /// Adds a plane to those that receive planar shadows, or removes it.
    Receiver,
    /// Adds an instance to those that cast planar shadows, or removes it.
    Caster,
}

/// The tools of the toolbar with their names and hints.
pub const TOOLS: [(Tool, &str, &str); 5] = [
    (Tool::Look, "Look", "A click captures the mouse for looking around (Esc)"),
    (Tool::Meter, "Measure", "A click measures the light at a point (M)"),
    (Tool::Grid, "Grid", "A click measures a whole flat surface (G)"),
    (Tool::PatchView, "View from", "A click shows the view from that patch (N)"),
    (Tool::Choose, "Select", "A click selects an object (L)"),
];
