//! Settings of shadow volumes.

/// How shadow volumes are counted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VolumeSettings {
    /// Depth-pass counts triangles whose volumes reach the near plane by depth-fail. If off, shadows are wrong where
    /// the near plane cuts a volume, as in a textbook.
    pub near_plane_cure: bool,
    /// Distance of a far plane that cuts volumes off, metres; `None` is right.
    pub far_plane: Option<f32>,
    /// Triangles that meet at an edge share one volume. If off, each triangle has its own, which is slow and checks
    /// that joining is right. For depth-fail only.
    pub joined: bool,
}

impl Default for VolumeSettings {
    fn default() -> Self {
        Self { near_plane_cure: true, far_plane: None, joined: true }
    }
}
