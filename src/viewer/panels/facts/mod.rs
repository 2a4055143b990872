//! What the panels show and do not set, grouped by what it is about.

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

/// What the panels show and do not set.
#[derive(Clone, Default)]
pub struct Facts<'a> {
    /// The open scene.
    pub scene: SceneFacts<'a>,
    /// Its light: the bake that runs or has ended.
    pub bake: BakeFacts<'a>,
    /// The camera and how it moves.
    pub camera: CameraFacts<'a>,
    /// The picture beside the panels.
    pub picture: PictureFacts<'a>,
    /// The shadows in the picture.
    pub shadows: ShadowFacts<'a>,
    /// What has been measured.
    pub measurement: MeasurementFacts<'a>,
}
