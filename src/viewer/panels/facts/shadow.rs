//! Facts about real-time shadows.

/// What the panels show of real-time shadows.
#[derive(Clone, Copy, Default)]
pub struct ShadowFacts<'a> {
    /// Number of light samples: points and directions from which direct light comes.
    pub num_light_samples: usize,
    /// While the camera rests: samples of each lamp that have been accumulated, and how many there will be.
    pub num_points: Option<[u32; 2]>,
    /// Share of pixels in which the two compared techniques differ; `None` if no difference is shown.
    pub difference: Option<f32>,
    /// The known fault of the technique from this viewpoint.
    pub fault: Option<&'a str>,
    /// Name and duration in milliseconds of each pass of the last picture; empty if passes are not timed.
    pub laps: &'a [(&'static str, f32)],
    /// The durations come from the device's own clock.
    pub has_device_clock: bool,
}
