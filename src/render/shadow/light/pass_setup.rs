//! Layouts and sample count that all passes that light one sample are created with.

use super::uniforms::light_sample_layout;
use crate::gpu::Gpu;

/// Layouts of bind groups 0 and 1 of the passes, and the number of samples of their targets.
#[derive(Clone)]
pub struct PassSetup {
    /// Layout of bind group 0, the frame.
    pub frame_layout: wgpu::BindGroupLayout,
    /// Layout of bind group 1, the light sample.
    pub sample_layout: wgpu::BindGroupLayout,
    /// Samples a pixel of the targets.
    pub samples: u32,
}

impl PassSetup {
    /// Creates the setup of passes for targets with `samples` samples a pixel.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout, samples: u32) -> Self {
        Self { frame_layout: frame_layout.clone(), sample_layout: light_sample_layout(gpu), samples }
    }

    /// Returns the layouts of bind groups 0 and 1.
    pub fn groups(&self) -> [Option<&wgpu::BindGroupLayout>; 2] {
        [Some(&self.frame_layout), Some(&self.sample_layout)]
    }
}
