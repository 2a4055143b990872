//! Settings of path tracing and of two-pass ray tracing.

use glam::Vec3;

/// Settings of path tracing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSettings {
    /// Number of paths a pixel or point.
    pub samples: u32,
    /// Largest number of reflections between a lamp and the camera or the measured point. With 0, points receive direct
    /// light only, and pictures show only the lamps.
    pub max_bounces: u32,
    /// True if metals and glass reflect and transmit light. False gives the solution of radiosity, where metals absorb
    /// and glass is opaque.
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
    /// Number of camera rays a pixel.
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

/// Source of the light at a surface, in addition to traced direct light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ambient {
    /// No ambient light.
    None,
    /// Equal everywhere: the radiance of ideal white paint. Only perfect mirrors and panes are followed (Whitted 1980).
    Constant(Vec3),
    /// The indirect light of the bake.
    Indirect {
        /// Number of rays of the final gather at the first diffuse surface. Each uses the light stored at the surface
        /// that it hits. With 0, the light stored at the first surface is used.
        final_gather: u32,
    },
    /// All light of the bake, direct light included; lights are not traced.
    All,
}
