//! Facts that the panels show but cannot change, grouped by subject.

mod bake;
mod camera;
mod measurement;
mod picture;
mod scene;
mod shadow;

pub use bake::BakeFacts;
pub use camera::CameraFacts;
pub use measurement::MeasurementFacts;
pub use picture::PictureFacts;
pub use scene::SceneFacts;
pub use shadow::ShadowFacts;

/// Facts that the panels show but cannot change.
#[derive(Clone, Default)]
pub struct Facts<'a> {
    /// Facts about the open scene.
    pub scene: SceneFacts<'a>,
    /// Facts about its light and the bake that runs or has ended.
    pub bake: BakeFacts<'a>,
    /// Facts about the camera and its movement.
    pub camera: CameraFacts<'a>,
    /// Facts about the picture beside the panels.
    pub picture: PictureFacts<'a>,
    /// Facts about the shadows in the picture.
    pub shadows: ShadowFacts<'a>,
    /// Results of measurements.
    pub measurement: MeasurementFacts<'a>,
}
