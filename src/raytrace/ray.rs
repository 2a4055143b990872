//! A ray, and how its direction was chosen.

use glam::Vec3;

/// A ray, and how its direction was chosen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    pub origin: Vec3,
    /// Unit vector along the ray.
    pub direction: Vec3,
    pub source: RaySource,
}

/// How the direction of a ray was chosen.
///
/// It decides which share of a lamp's emission the ray accounts for when it hits the lamp. Samples of the lamps account
/// for the rest (multiple importance sampling).
#[derive(Clone, Copy, Debug)]
pub(crate) enum RaySource {
    /// By the camera. The ray passes through the backs of single-sided surfaces, so a room can be viewed from outside.
    Camera,
    /// At random, where lamps are not sampled: the ray accounts for all emission that it hits.
    Unshared,
    /// By a diffuse reflection about `normal`, with `density` per steradian, where lamps are sampled as well.
    Diffuse { normal: Vec3, density: f32 },
    /// By a reflection in glossy metal about `normal`, with `density` per steradian, where lamps are sampled as well.
    Glossy { normal: Vec3, density: f32 },
    /// By a diffuse reflection, and the ray has passed a pane. Only the samples of the lamps account for lamps behind
    /// panes.
    BehindPane,
}

impl RaySource {
    /// Returns the source of a ray that metal reflects in a direction with `density` per steradian, or 0 for a perfect
    /// mirror.
    pub(crate) fn reflected(normal: Vec3, density: f32) -> Self {
        if density > 0.0 { Self::Glossy { normal, density } } else { Self::Unshared }
    }

    /// Returns the source of a ray after it has passed a pane.
    pub(crate) fn behind_pane(self) -> Self {
        match self {
            Self::Diffuse { .. } => Self::BehindPane,
            // At metal, lamps behind panes are not sampled.
            Self::Glossy { .. } => Self::Unshared,
            other => other,
        }
    }
}
