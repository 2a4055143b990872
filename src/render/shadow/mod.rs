//! Real-time direct light with shadows, by techniques that can be switched and compared.
//!
//! A bake stores direct and indirect light. In place of the stored direct light, `real_time` adds the light samples
//! of a scene, each wherever it is not in shadow. Each technique is a module:
//!
//! * `map`: shadow maps with percentage-closer filtering (Williams 1978; Reeves et al. 1987)
//! * `volume`: shadow volumes in the stencil, z-pass and z-fail (Heidmann 1991; Everitt and Kilgard 2002)
//! * `planar`: casters projected on to large planes (Blinn 1988)
//! * `raytraced`: one ray for each pixel and light sample, the reference
//! * `cutout`: shadows of casters with holes, for the techniques that use outlines only
//!
//! They use `shared` (frame, casters, pipelines) and `light` (light samples, the direct light pass), and never import
//! each other. `dispatch` chooses the passes of a technique, `debug` draws the data of a technique, and `comparison`
//! measures how far two techniques differ.
//!
//! Surfaces that blend throw shadows as if they were solid from half opacity on. They receive none and show the light
//! of the bake.

pub(crate) mod comparison;
pub(crate) mod debug;
pub(crate) mod few_lights;
pub(crate) mod light;
pub(crate) mod map;
pub(crate) mod planar;
pub(crate) mod real_time;
pub(crate) mod shared;
pub(crate) mod volume;

mod cutout;
mod dispatch;
mod raytraced;
mod scene;
mod settings;
mod technique;

pub use comparison::{
    ComparedScene, Decisions, SampleDecisions, ShadowComparison, ShadowDifference, shadow_difference,
};
pub use debug::{DebugView, DebugViewInfo, ShadowDebug, count_colour};
pub use dispatch::known_fault;
pub use light::batch::{MOST_POINTS, SampleBatch, num_batches};
pub use light::sample::LightSample;
pub use light::samples::light_samples;
pub use map::settings::MapSettings;
pub use planar::settings::PlanarSettings;
pub(crate) use real_time::RealTimeLight;
pub use settings::ShadowSettings;
pub(crate) use shared::frame_context::FrameContext;
pub use shared::scene::ShadowScene;
pub use technique::{ShadowTechnique, TechniqueInfo};
pub use volume::KnownFault;
pub use volume::settings::VolumeSettings;
