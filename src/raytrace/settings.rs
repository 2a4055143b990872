//! What the ray tracers are asked for.

/// Settings of path tracing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSettings {
    /// Paths a pixel or point.
    pub samples: u32,
    /// Light is followed from the lamp through at most this many reflections; 0 leaves direct light at points, and only
    /// the lamps in pictures.
    pub max_bounces: u32,
    /// Metals and glass send light on; false is what radiosity solves, where they do not.
    pub has_specular: bool,
    /// Another seed is another, independent estimate.
    pub seed: u32,
}

impl Default for PathSettings {
    fn default() -> Self {
        Self { samples: 256, max_bounces: u32::MAX, has_specular: true, seed: 0 }
    }
}
