//! Facts about the picture and the frame rate.

/// Facts about the picture and its frames.
#[derive(Clone, Copy)]
pub struct PictureFacts<'a> {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Rays per pixel of the traced view; `None` if the view is rasterised.
    pub num_rays: Option<u32>,
    /// True while a picture is being written to a file.
    pub is_writing: bool,
    /// Frames per second during a movement.
    pub frame_rate: f32,
    /// Duration of a frame, seconds.
    pub frame_seconds: f32,
    /// Name of the graphics device.
    pub adapter: &'a str,
}

impl Default for PictureFacts<'_> {
    fn default() -> Self {
        Self { size: [1, 1], num_rays: None, is_writing: false, frame_rate: 0.0, frame_seconds: 0.0, adapter: "" }
    }
}
