//! How direct light is drawn: the technique, its settings, and the light samples.

use std::sync::Arc;

use super::light::batch::{MOST_POINTS, SampleBatch, batch_of_samples};
use super::light::sample::LightSample;
use super::light::samples::samples_of;
use super::map::settings::MapSettings;
use super::planar::settings::PlanarSettings;
use super::shared::scene::ShadowScene;
use super::technique::ShadowTechnique;
use super::volume::settings::VolumeSettings;

/// Settings of direct light.
#[derive(Clone, Debug, PartialEq)]
pub struct ShadowSettings {
    /// Technique that finds shadows.
    pub technique: ShadowTechnique,
    /// Number of samples for each lamp that has a size, 1 to 256. Each throws one hard shadow.
    pub light_samples: u32,
    /// Radius of point and spot lights, metres; with 0 they are points.
    pub light_radius: f32,
    /// The light samples that this picture adds to the sum of previous pictures; `None` draws all samples at once.
    pub batch: Option<SampleBatch>,
    /// Settings of planar shadows.
    pub planar: PlanarSettings,
    /// Settings of shadow maps.
    pub maps: MapSettings,
    /// Settings of shadow volumes.
    pub volumes: VolumeSettings,
}

impl ShadowSettings {
    /// Returns settings of `technique` with the cures for all its faults switched on.
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

    /// Returns the light samples of a scene that one picture draws.
    #[must_use]
    pub fn samples(&self, shadows: &ShadowScene) -> Arc<[LightSample]> {
        let Some(batch) = self.batch else { return samples_of(shadows, self.light_samples, self.light_radius) };
        let all = samples_of(shadows, MOST_POINTS, self.light_radius);
        let samples = batch_of_samples(&all, self.light_samples, batch.number);
        samples.into_iter().skip(batch.first).take(batch.count).collect()
    }
}
