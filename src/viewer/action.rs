//! Actions that panels and keys request.

use std::path::PathBuf;

use crate::viewer::settings::tool::Tool;

/// An action that a panel or a key requests.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Bakes the open scene with the chosen preset.
    Bake,
    /// Ends the bake. The light solved so far remains.
    CancelBake,
    /// Starts a bake, or ends the one that runs.
    ToggleBake,
    /// Writes the light that is shown as a .glb.
    SaveBake,
    /// Goes to a camera of the file, by its index.
    GoToCamera(usize),
    /// Goes this many cameras of the file further.
    StepCamera(isize),
    /// Goes to the bookmark of a number.
    GoToBookmark(u8),
    /// Sets the bookmark of a number.
    SetBookmark(u8),
    /// Moves the camera back until the scene is in view.
    FrameAll,
    /// Marks the locations of a piece of advice, by its index, and flies to the next one.
    ShowAdvice(usize),
    /// Moves the camera back until an instance, by its index, is in view.
    FrameInstance(usize),
    /// Sets the vertical field of view, degrees.
    SetFieldOfView(f32),
    /// Switches between walking and flying.
    ToggleWalking,
    /// Writes a picture of the size of the window.
    Screenshot,
    /// Writes a picture with the settings of the panel.
    WritePicture,
    /// Cancels the picture that is being written.
    CancelPicture,
    /// Opens the built-in scene.
    OpenBuiltIn,
    /// Opens a file.
    Open(PathBuf),
    /// Opens the dialog that chooses a file.
    ChooseFile,
    /// Loads the open file again.
    Reload,
    /// Loads the open file in a material variant; `None` stands for the default materials.
    SetVariant(Option<String>),
    /// Selects what a click in the picture does.
    SelectTool(Tool),
    /// Pins the last reading of the meter.
    PinReading,
    /// Drops all readings and the grid.
    ClearReadings,
    /// Closes the view from a patch.
    ClosePatchView,
    /// Writes the readings and the grid as a table.
    WriteReadings,
    /// Records the bake for the time machine, or cancels the recording.
    ToggleRecording,
    /// Fits the scale of the false colours to the light of the scene.
    FitLuxScale,
    /// Raises the exposure by this many thirds of a stop.
    StepExposure(f32),
    /// Switches between automatic and fixed exposure.
    ToggleAutoExposure,
    /// Switches to the other tone map.
    NextToneMap,
    /// Switches to the next shading of surfaces.
    NextShading,
    /// Shows or hides direct light.
    ToggleDirect,
    /// Shows or hides indirect light.
    ToggleIndirect,
    /// Switches tracing of the view at rest on or off.
    ToggleStills,
    /// Shows or hides the key sheet.
    ToggleHelp,
    /// Shows or hides the side panel.
    TogglePanels,
    /// Switches between full screen and window.
    ToggleFullScreen,
}
