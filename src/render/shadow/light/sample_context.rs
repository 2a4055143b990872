//! Input of a pass for one light sample.

use super::sample::LightSample;
use super::uniforms::LightUniforms;
use crate::render::shadow::settings::ShadowSettings;
use crate::render::shadow::shared::frame_context::FrameContext;

/// A light sample of a picture.
#[derive(Clone, Copy)]
pub struct SampleContext<'a> {
    /// The picture.
    pub frame: FrameContext<'a>,
    /// Settings of the shadows.
    pub settings: &'a ShadowSettings,
    /// All light samples of the picture on the device.
    pub lights: &'a LightUniforms,
    /// Index of this sample in `lights`.
    pub index: usize,
    /// The sample itself.
    pub sample: &'a LightSample,
}

impl SampleContext<'_> {
    /// Sets bind groups 0 and 1.
    pub fn bind(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_bind_group(0, self.frame.bindings, &[]);
        self.lights.bind(pass, self.index);
    }
}
