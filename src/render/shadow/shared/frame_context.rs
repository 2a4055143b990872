//! Input of every shadow pass of a picture.

use std::time::Instant;

use super::scene::ShadowScene;
use crate::gpu::{Gpu, Stopwatch};
use crate::render::scene::SceneBuffers;
use crate::render::{RenderSettings, View};

/// The picture that is being drawn. All its passes receive the same values.
#[derive(Clone, Copy)]
pub struct FrameContext<'a> {
    /// The device.
    pub gpu: &'a Gpu,
    /// Bind group 0: camera, exposure and weights of the light groups.
    pub bindings: &'a wgpu::BindGroup,
    /// Pixels across and down.
    pub size: [u32; 2],
    /// All triangles of the scene: the casters, whether in view or not.
    pub scene: &'a SceneBuffers,
    /// The triangles that may be in view: the receivers.
    pub in_view: &'a SceneBuffers,
    /// Casters and lights of the scene.
    pub shadows: &'a ShadowScene,
    /// The camera.
    pub view: &'a View,
    /// How surfaces are shown, and how bright each light group is.
    pub render_settings: &'a RenderSettings,
    /// Stopwatch for the time of each pass; `None` if times are not displayed.
    pub stopwatch: Option<&'a Stopwatch>,
}

impl FrameContext<'_> {
    /// Records the time of the passes that were recorded since the last call under `name`.
    pub fn lap(&self, encoder: &mut wgpu::CommandEncoder, name: &'static str) {
        self.stopwatch.iter().for_each(|stopwatch| stopwatch.lap(encoder, name));
    }

    /// Runs `work` on the CPU and records its time under `name`.
    pub fn time_work<T>(&self, name: &'static str, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        self.stopwatch.iter().for_each(|stopwatch| stopwatch.work(name, start.elapsed()));
        result
    }
}
