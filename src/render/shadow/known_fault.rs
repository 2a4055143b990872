//! Where a technique is known to be wrong from here.

use glam::{Vec3, Vec4};

use super::exact_rays::Line;
use super::{ShadowScene, ShadowSettings, ShadowTechnique};
use crate::render::View;

/// Why shadows are known to be wrong from here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KnownFault {
    /// Depth-pass without its cure counts from outside, but the eye is in the volume of this lamp.
    EyeInVolume {
        /// Number of the lamp, as samples count them.
        lamp: usize,
    },
    /// Depth-pass without its cure, and the near plane is half in the volume of this lamp.
    NearPlaneCutsVolume {
        /// Number of the lamp, as samples count them.
        lamp: usize,
    },
    /// Depth-fail with a far plane, which cuts off the sides and caps that it counts.
    FarPlaneCutsVolumes,
}

/// What is known to be wrong with the shadows of `settings`, seen by `view`; none means nothing is known.
#[must_use]
pub fn known_fault(shadows: &ShadowScene, view: &View, settings: &ShadowSettings) -> Option<KnownFault> {
    match settings.technique {
        ShadowTechnique::VolumeDepthPass if !settings.volumes.near_plane_cure => {
            let corners = near_plane(view);
            let samples = settings.samples(shadows);
            samples.iter().find_map(|sample| in_shadow(shadows, &corners, sample.place(), sample.lamp))
        }
        ShadowTechnique::VolumeDepthFail => settings.volumes.far_plane.map(|_| KnownFault::FarPlaneCutsVolumes),
        _ => None,
    }
}

/// The near plane's middle and corners.
fn near_plane(view: &View) -> [Vec3; 5] {
    let world_from_projection = view.projection_from_world().inverse();
    [(0.0, 0.0), (-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)]
        .map(|(x, y)| world_from_projection.project_point3(Vec3::new(x, y, 1.0)))
}

fn in_shadow(shadows: &ShadowScene, corners: &[Vec3; 5], light: Vec4, lamp: usize) -> Option<KnownFault> {
    let is_dark = |corner: &&Vec3| shadows.rays().is_blocked(Line::between(corner.as_dvec3(), light.as_dvec4()));
    match corners.iter().filter(is_dark).count() {
        0 => None,
        5 => Some(KnownFault::EyeInVolume { lamp }),
        _ => Some(KnownFault::NearPlaneCutsVolume { lamp }),
    }
}
