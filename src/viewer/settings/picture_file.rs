//! Settings of the pictures that are written to files.

/// Size, format and method of a large picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct PictureSettings {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Linear radiance as .exr instead of display colours as .png.
    pub is_exr: bool,
    /// Rays a pixel; 0 draws the picture by rasterisation.
    pub num_rays: u32,
}

impl Default for PictureSettings {
    fn default() -> Self {
        Self { size: [1920, 1080], is_exr: false, num_rays: 0 }
    }
}

impl PictureSettings {
    /// Ending of the file name.
    #[must_use]
    pub fn ending(&self) -> &'static str {
        if self.is_exr { "exr" } else { "png" }
    }
}
