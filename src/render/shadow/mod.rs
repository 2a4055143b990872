//! The shadow laboratory: direct light from the lights themselves, in the shadows of a technique of one's choice.
//!
//! The stored light of a bake needs no shadow; direct light is added on top, light sample by light sample, wherever
//! [`real_time`] finds no shadow. Each technique is a file here; `raytraced` is the truth against which
//! [`difference`] measures the others. Deliberately absent: shadows of surfaces that blend (they count as solid from
//! half opacity on) and shadows on them (they keep the light of the bake).

pub mod casters;
pub mod debug;
pub mod difference;
pub mod light_samples;
pub mod planar_shadow;
pub mod real_time;
pub mod scene;
pub mod shadow_map;
pub mod shadow_volume;
pub mod silhouette;

mod batch;
mod cutout_shadow;
mod depth_prepass;
mod direct_light;
mod exact_rays;
pub mod few_lights;
pub mod flattening;
mod known_fault;
mod light_space;
mod light_targets;
mod light_uniforms;
mod map_cache;
mod map_light;
mod map_overview;
mod map_pipelines;
mod map_projection;
mod near_plane;
mod pipeline;
mod raytraced;
mod solid;
mod visible_points;
mod volume_pipelines;

pub use batch::{Batch, MOST_POINTS, num_batches};
pub use debug::{DebugView, ShadowDebug};
pub use difference::{Case, Decisions, Judge, ShadowDifference, shadow_difference};
pub use known_fault::{KnownFault, known_fault};
pub use light_samples::{LightSample, light_samples};
pub use planar_shadow::PlanarSettings;
pub use real_time::RealTimeLight;
pub use scene::ShadowScene;
pub use shadow_map::MapSettings;
pub use shadow_volume::VolumeSettings;

use std::sync::Arc;

use batch::batch_of_samples;

/// How shadows are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShadowTechnique {
    /// Not at all: light passes through everything.
    None,
    /// Depth seen from the light (Williams 1978).
    Map,
    /// Stencil volumes counted in front of what is seen (Heidmann 1991).
    VolumeDepthPass,
    /// Stencil volumes counted behind what is seen (Everitt, Kilgard 2002).
    VolumeDepthFail,
    /// Casters flattened on to a few large planes (Blinn 1988).
    Planar,
    /// One ray a pixel and light sample, on the CPU: the truth.
    Raytraced,
}

/// How direct light is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct ShadowSettings {
    /// How shadows are found.
    pub technique: ShadowTechnique,
    /// Points on each lamp that has a size, 1 to 256; each throws one hard shadow.
    pub light_samples: u32,
    /// Size that point and spot lights are given, metres; 0 leaves them points.
    pub light_radius: f32,
    /// Light samples that are added to those of the last pictures; none draws all samples at once.
    pub batch: Option<Batch>,
    /// Of planar shadows.
    pub planar: PlanarSettings,
    /// Of shadow maps.
    pub maps: MapSettings,
    /// Of shadow volumes.
    pub volumes: VolumeSettings,
}

impl ShadowSettings {
    /// The lights of a scene as points and directions.
    #[must_use]
    pub fn samples(&self, shadows: &ShadowScene) -> Arc<[LightSample]> {
        let Some(batch) = self.batch else { return shadows.light_samples(self.light_samples, self.light_radius) };
        let all = shadows.light_samples(MOST_POINTS, self.light_radius);
        let samples = batch_of_samples(&all, self.light_samples, batch.number);
        samples.into_iter().skip(batch.first).take(batch.count).collect()
    }

    /// `technique` with the settings that show none of its faults.
    #[must_use]
    pub fn new(technique: ShadowTechnique) -> Self {
        Self {
            technique,
            light_samples: 1,
            light_radius: 0.0,
            batch: None,
            planar: PlanarSettings::default(),
            maps: MapSettings::default(),
            volumes: VolumeSettings::default(),
        }
    }
}
