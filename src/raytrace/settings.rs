//! What the ray tracers are asked for.

use glam::Vec3;

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

/// Settings of two-pass ray tracing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoPassSettings {
    /// Rays from the eye a pixel.
    pub samples: u32,
    /// Where light comes from that does not come straight from the lights.
    pub ambient: Ambient,
    /// Another seed is another, independent estimate.
    pub seed: u32,
}

impl Default for TwoPassSettings {
    fn default() -> Self {
        Self { samples: 32, ambient: Ambient::Indirect { final_gather: 0 }, seed: 0 }
    }
}

/// The light at a surface that is not traced to the lights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ambient {
    /// None.
    None,
    /// The same everywhere: the radiance that ideal white paint shows. Only perfect mirrors and panes are followed.
    Constant(Vec3),
    /// The indirect light of the bake.
    Indirect {
        /// Rays that look for it at the first diffuse surface, and take it from the next; 0 takes it from the vertices.
        final_gather: u32,
    },
    /// All light is that of the bake; lights are not traced.
    All,
}
