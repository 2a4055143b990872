//! Settings of the pictures that are written to files.

/// Size, format and method of a large picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct PictureSettings {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// True for linear radiance as .exr, false for display colours as .png.
    pub is_exr: bool,
    /// Rays per pixel; 0 draws the picture by rasterisation.
    pub num_rays: u32,
}

impl Default for PictureSettings {
    fn default() -> Self {
        Self { size: [1920, 1080], is_exr: false, num_rays: 0 }
    }
}

impl PictureSettings {
    /// Returns the extension of the file name.
    #[must_use]
    pub fn ending(&self) -> &'static str {
        if self.is_exr { "exr" } else { "png" }
    }
}
