//! Detects views from which shadow volumes are known to be wrong because their cures are switched off.

use glam::{Vec3, Vec4};

use super::hull::Counting;
use super::settings::VolumeSettings;
use crate::render::View;
use crate::render::shadow::light::sample::LightSample;
use crate::render::shadow::shared::exact_rays::Line;
use crate::render::shadow::shared::scene::ShadowScene;

/// Reason why shadows are known to be wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KnownFault {
    /// Depth-pass without its cure, and the eye is in a volume of this lamp. The count assumes an eye outside all
    /// volumes.
    EyeInVolume {
        /// [`LightSample::lamp`].
        lamp: usize,
    },
    /// Depth-pass without its cure, and a part of the near plane is in a volume of this lamp.
    NearPlaneCutsVolume {
        /// [`LightSample::lamp`].
        lamp: usize,
    },
    /// Depth-fail with a far plane. It cuts off sides and caps that have to be counted.
    FarPlaneCutsVolumes,
}

/// Returns the fault of a way to count volumes from `view`; `None` if none is known.
#[must_use]
pub fn fault_of_counting(
    shadows: &ShadowScene,
    view: &View,
    counting: Counting,
    settings: &VolumeSettings,
    samples: &[LightSample],
) -> Option<KnownFault> {
    match counting {
        Counting::DepthPass if settings.near_plane_cure => None,
        Counting::DepthPass => {
            let points = near_plane_points(view);
            samples.iter().find_map(|sample| fault_of_lamp(shadows, &points, sample.position(), sample.lamp))
        }
        Counting::DepthFail => settings.far_plane.map(|_| KnownFault::FarPlaneCutsVolumes),
    }
}

/// Returns the middle and the corners of the near plane.
fn near_plane_points(view: &View) -> [Vec3; 5] {
    let world_from_projection = view.projection_from_world().inverse();
    [(0.0, 0.0), (-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)]
        .map(|(x, y)| world_from_projection.project_point3(Vec3::new(x, y, 1.0)))
}

fn fault_of_lamp(shadows: &ShadowScene, points: &[Vec3; 5], light: Vec4, lamp: usize) -> Option<KnownFault> {
    let is_dark = |point: &&Vec3| shadows.rays().is_blocked(Line::between(point.as_dvec3(), light.as_dvec4()));
    match points.iter().filter(is_dark).count() {
        0 => None,
        5 => Some(KnownFault::EyeInVolume { lamp }),
        _ => Some(KnownFault::NearPlaneCutsVolume { lamp }),
    }
}
