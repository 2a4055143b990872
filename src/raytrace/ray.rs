//! A ray, and how its direction was chosen.

use glam::Vec3;

/// A ray, and how its direction was chosen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    pub origin: Vec3,
    /// Unit vector.
    pub direction: Vec3,
    pub source: RaySource,
}

/// How the direction of a ray was chosen.
///
/// It decides which share of a lamp's emission the ray accounts for when it meets the lamp: the rest is found by
/// samples of the lamps (multiple importance sampling).
#[derive(Clone, Copy, Debug)]
pub(crate) enum RaySource {
    /// By the camera. The ray passes through the backs of single-sided surfaces, into a room from outside.
    Camera,
    /// At random, where no lamp is sampled as well: the ray accounts for all emission that it meets.
    Unshared,
    /// By a diffuse reflection about `normal`, with `density` per steradian, where lamps are sampled as well.
    Diffuse { normal: Vec3, density: f32 },
    /// As [`RaySource::Diffuse`], by a reflection in glossy metal.
    Glossy { normal: Vec3, density: f32 },
    /// By a diffuse reflection, and the ray has passed a pane: lamps behind panes are left to the samples of the lamps.
    BehindPane,
}

impl RaySource {
    /// The source of a ray that metal reflects, in a direction with `density` per steradian, or 0 for a perfect mirror.
    pub(crate) fn reflected(normal: Vec3, density: f32) -> Self {
        if density > 0.0 { Self::Glossy { normal, density } } else { Self::Unshared }
    }

    /// The source of a ray after it has passed a pane.
    pub(crate) fn behind_pane(self) -> Self {
        match self {
            Self::Diffuse { .. } => Self::BehindPane,
            // Metal takes no samples of lamps behind panes.
            Self::Glossy { .. } => Self::Unshared,
            other => other,
        }
    }
}
