//! Facts about real-time shadows.

/// Facts about the real-time shadows of the picture.
#[derive(Clone, Copy, Default)]
pub struct ShadowFacts<'a> {
    /// Number of light samples: points and directions from which direct light comes.
    pub num_light_samples: usize,
    /// While the camera rests: samples per lamp that have been accumulated, and their final number.
    pub num_points: Option<[u32; 2]>,
    /// Share of pixels in which the two compared techniques differ; `None` if no difference is shown.
    pub difference: Option<f32>,
    /// Known fault of the technique from this viewpoint; `None` if there is none.
    pub fault: Option<&'a str>,
    /// Name and duration in milliseconds of each pass of the last picture; empty if passes are not timed.
    pub laps: &'a [(&'static str, f32)],
    /// True if the durations come from timestamps of the device.
    pub has_device_clock: bool,
}
