//! Direct light, added one light sample after the other, in the same way for every shadow technique.
//!
//! A lamp becomes [`samples`]: points and directions that each throw one hard shadow. [`direct_light`] adds the
//! irradiance of one sample to the [`targets`] of a picture. A technique implements [`shadow_pass::ShadowPass`] to mark
//! where the sample is hidden.

pub mod batch;
pub mod direct_light;
pub mod emitters;
pub mod pass_setup;
pub mod sample;
pub mod sample_context;
pub mod samples;
pub mod shadow_pass;
pub mod space;
pub mod targets;
pub mod uniforms;
pub mod unshadowed;
