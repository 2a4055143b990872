//! Options with which the window opens.

use std::path::PathBuf;

use crate::bake::BakeSettings;

/// Options with which the window opens.
#[derive(Clone, Debug)]
pub struct ViewerOptions {
    /// The glTF file; `None` opens the built-in scene.
    pub scene: Option<PathBuf>,
    /// The material variant of the file; `None` takes the default materials.
    pub variant: Option<String>,
    /// Settings of the bake if the file has no light.
    pub settings: BakeSettings,
    /// The folder that shaders are read from and watched in; `None` takes the shaders built into the program.
    pub shaders: Option<PathBuf>,
    /// The file into which the time of each frame is written.
    pub frame_log: Option<PathBuf>,
}
