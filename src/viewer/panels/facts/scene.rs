//! Facts about the open scene.

use crate::scene::Scene;
use crate::viewer::session::advice::Advice;

/// Facts about the open scene, with what is chosen in it.
#[derive(Clone, Copy, Default)]
pub struct SceneFacts<'a> {
    /// The open scene; `None` if there is none.
    pub open: Option<&'a Scene>,
    /// The chosen material variant of the file; `None` for the default materials.
    pub variant: Option<&'a str>,
    /// Number of triangles that store light; `None` before the first light.
    pub num_elements: Option<usize>,
    /// Findings of the loader and the mesh doctor.
    pub advice: &'a [Advice],
}
