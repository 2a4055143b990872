//! Settings of path tracing and of two-pass ray tracing.

use glam::Vec3;

/// Settings of path tracing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSettings {
    /// Paths a pixel or point.
    pub samples: u32,
    /// Most reflections between a lamp and the camera or the measured point; 0 leaves direct light at points, and only
    /// the lamps in pictures.
    pub max_bounces: u32,
    /// Metals and glass send light on. False gives what radiosity solves, where metals absorb and glass is opaque.
    pub has_specular: bool,
    /// Different seeds give independent estimates.
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
    /// Camera rays a pixel.
    pub samples: u32,
    /// Source of the light that does not come straight from the lights.
    pub ambient: Ambient,
    /// Different seeds give independent estimates.
    pub seed: u32,
}

impl Default for TwoPassSettings {
    fn default() -> Self {
        Self { samples: 32, ambient: Ambient::Indirect { final_gather: 0 }, seed: 0 }
    }
}

/// The light at a surface that is not traced to a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ambient {
    /// There is none.
    None,
    /// Equal everywhere: the radiance of ideal white paint. Only perfect mirrors and panes are followed (Whitted 1980).
    Constant(Vec3),
    /// The indirect light of the bake.
    Indirect {
        /// Rays of the final gather from the first diffuse surface, which take the light stored at the next one; 0
        /// takes the light stored at the first.
        final_gather: u32,
    },
    /// All light of the bake, direct light included; lights are not traced.
    All,
}
