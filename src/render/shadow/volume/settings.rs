//! Settings of shadow volumes.

/// Settings of shadow volumes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VolumeSettings {
    /// True if depth-pass uses depth-fail for the triangles whose volumes reach the near plane. If false, as in the
    /// textbook method, shadows are wrong where the near plane cuts a volume.
    pub near_plane_cure: bool,
    /// Distance of a far plane that cuts volumes off, metres. `None` is correct; a far plane shows the fault.
    pub far_plane: Option<f32>,
    /// True if triangles that share an edge share one volume. If false, each triangle has its own, which is slow and
    /// serves to check the joined volume. For depth-fail only.
    pub joined: bool,
}

impl Default for VolumeSettings {
    fn default() -> Self {
        Self { near_plane_cure: true, far_plane: None, joined: true }
    }
}
