//! What panels and keys make the viewer do.

use std::path::PathBuf;

use super::tool::Tool;

/// What a panel or a key makes the viewer do.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Bake the open scene with the chosen preset.
    Bake,
    /// End the bake and keep the light solved so far.
    CancelBake,
    /// Start a bake, or end the running one.
    ToggleBake,
    /// Write the current light as a .glb.
    SaveBake,
    /// Go to a camera of the file, by index.
    Jump(usize),
    /// Go to the camera this many places further in the list.
    StepCamera(isize),
    /// Go to the bookmark with this number.
    Recall(u8),
    /// Store this view as the bookmark with this number.
    Bookmark(u8),
    /// Move back until the whole scene is in view.
    FrameAll,
    /// Mark the next location of the advice with this index and fly there.
    ShowWhere(usize),
    /// Move back until the instance with this index is in view.
    FrameInstance(usize),
    /// Set the vertical field of view, degrees.
    SetFieldOfView(f32),
    /// Switch between walking and flying.
    ToggleWalking,
    /// Write a picture of the window's size.
    Screenshot,
    /// Write a picture with the size and quality set in the panel.
    WritePicture,
    /// Cancel the picture that is being written.
    CancelPicture,
    /// Open the built-in scene.
    OpenBuiltIn,
    /// Open a file.
    Open(PathBuf),
    /// Open the dialog that chooses a file.
    ChooseFile,
    /// Read the open file again.
    Reload,
    /// Read the open file with this material variant; `None` for the default materials.
    SetVariant(Option<String>),
    /// Choose what a click in the picture does.
    Take(Tool),
    /// Pin the last reading of the meter.
    Pin,
    /// Discard all readings and the grid.
    ClearReadings,
    /// Close the view from a patch.
    ClosePatchView,
    /// Write readings and grid as a table.
    WriteReadings,
    /// Record the bake for the time machine, or stop recording.
    ToggleRecording,
    /// Fit the scale of the false colours to the light of the scene.
    FitLuxScale,
    /// Raise the exposure by this many thirds of a stop.
    StepExposure(f32),
    /// Switch between metered and fixed exposure.
    ToggleAutoExposure,
    /// Switch to the other tone map.
    NextToneMap,
    /// Switch to the next shading.
    NextShading,
    /// Show or hide direct light.
    ToggleDirect,
    /// Show or hide indirect light.
    ToggleIndirect,
    /// Switch ray tracing for a resting camera on or off.
    ToggleStills,
    /// Show or hide the key sheet.
    ToggleHelp,
    /// Show or hide the side panel.
    TogglePanels,
    /// Switch between full screen and window.
    ToggleFullScreen,
}
