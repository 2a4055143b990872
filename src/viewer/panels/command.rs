//! What panels and keys ask for.

use std::path::PathBuf;

/// What a panel or a key asks the program to do.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Bake the open scene with the preset that is set.
    Bake,
    /// End the bake and keep what is solved.
    CancelBake,
    /// Bake, or end the bake that runs.
    ToggleBake,
    /// Write the light that is shown as a .glb.
    SaveBake,
    /// Go to a camera of the file.
    Jump(usize),
    /// Another camera of the file, so many further.
    StepCamera(isize),
    /// Go to the view that is marked with a number.
    Recall(u8),
    /// Mark this view with a number.
    Bookmark(u8),
    /// Stand back until all is in view.
    FrameAll,
    /// Mark what a piece of advice, by its number, is about, and fly to the next place of it.
    ShowWhere(usize),
    /// Stand back until an instance is in view.
    FrameInstance(usize),
    /// See with another vertical field of view, degrees.
    SetFieldOfView(f32),
    /// Between walking and flying.
    ToggleWalking,
    /// Write a picture of the window's size.
    Screenshot,
    /// Write a picture as large and as good as the panel says.
    WritePicture,
    /// End the picture that is being written.
    CancelPicture,
    /// Open the built-in scene.
    OpenBuiltIn,
    /// Open a file.
    Open(PathBuf),
    /// Let the user choose a file.
    ChooseFile,
    /// Read the open file again.
    Reload,
    /// Read the open file in another material variant; none is what it wears without.
    Wear(Option<String>),
    /// What a click in the picture does.
    Take(Tool),
    /// Keep the meter's reading.
    Pin,
    /// Drop all readings and the grid.
    ClearReadings,
    /// Drop the view from a patch.
    ForgetSight,
    /// Write readings and grid as a table.
    WriteReadings,
    /// Record the bake for the time machine, or stop recording.
    ToggleRecording,
    /// The false colours span the light of the scene.
    FitLuxScale,
    /// Brighter by so many thirds of a stop.
    StepExposure(f32),
    /// Metered or fixed exposure.
    ToggleAutoExposure,
    /// The other tone map.
    NextToneMap,
    /// The next way to show surfaces.
    NextShading,
    /// Direct light shown or not.
    ToggleDirect,
    /// Indirect light shown or not.
    ToggleIndirect,
    /// Rays for a still camera or not.
    ToggleStills,
    /// Key sheet shown or not.
    ToggleHelp,
    /// Side panel shown or not.
    TogglePanels,
    /// Full screen or window.
    ToggleFullScreen,
}

/// What a click in the picture does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Keeps the mouse for looking around.
    #[default]
    Look,
    /// Measures a point.
    Meter,
    /// Measures a grid over a flat surface.
    Grid,
    /// Shows what the patch sees.
    Sight,
    /// Chooses an instance.
    Choose,
    /// Chooses a plane that receives planar shadows, or drops it again.
    Receiver,
    /// Chooses an instance that throws planar shadows, or drops it again.
    Caster,
}

/// Tools with their names and meanings.
pub const TOOLS: [(Tool, &str, &str); 5] = [
    (Tool::Look, "Look", "A click keeps the mouse for looking around (Esc)"),
    (Tool::Meter, "Measure", "A click measures the light at a point (M)"),
    (Tool::Grid, "Grid", "A click measures a whole flat surface (G)"),
    (Tool::Sight, "View from", "A click shows what that patch sees (N)"),
    (Tool::Choose, "Select", "A click selects what it meets (L)"),
];
