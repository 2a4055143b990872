//! Draws a scene with two techniques and compares their decisions.

use super::decisions::{Decisions, decisions, stencil};
use super::difference::{ShadowDifference, shadow_difference};
use crate::gpu::{Gpu, GpuError};
use crate::render::frame_uniform::{frame_bind_group, frame_layout};
use crate::render::scene::SceneBuffers;
use crate::render::shadow::real_time::RealTimeLight;
use crate::render::shadow::settings::ShadowSettings;
use crate::render::shadow::shared::frame_context::FrameContext;
use crate::render::shadow::shared::scene::ShadowScene;
use crate::render::shadow::technique::ShadowTechnique;
use crate::render::{RenderSettings, View};

/// Compares shadow techniques. Its passes are created once and used for every comparison.
pub struct ShadowComparison {
    layout: wgpu::BindGroupLayout,
    light: RealTimeLight,
}

/// The picture in which techniques are compared.
#[derive(Clone, Copy)]
pub struct ComparedScene<'a> {
    /// The scene on the device.
    pub scene: &'a SceneBuffers,
    /// Its casters and lights.
    pub shadows: &'a ShadowScene,
    /// The camera.
    pub view: &'a View,
    /// Pixels across and down.
    pub size: [u32; 2],
}

impl ShadowComparison {
    /// Creates passes with one sample a pixel.
    #[must_use]
    pub fn new(gpu: &Gpu) -> Self {
        let layout = frame_layout(gpu);
        Self { light: RealTimeLight::new(gpu, &layout, 1), layout }
    }

    /// Compares two techniques. Returns their difference and the decisions of the reference: the ray-traced technique
    /// if it is one of the two, else `b`.
    ///
    /// # Errors
    /// Returns an error if the device was lost.
    pub fn compare(
        &mut self,
        gpu: &Gpu,
        scene: ComparedScene<'_>,
        a: &ShadowSettings,
        b: &ShadowSettings,
    ) -> Result<(ShadowDifference, Decisions), GpuError> {
        let (of_a, of_b) = (self.decisions(gpu, scene, a)?, self.decisions(gpu, scene, b)?);
        let is_a_reference = a.technique == ShadowTechnique::Raytraced;
        let (compared, reference) = if is_a_reference { (of_b, of_a) } else { (of_a, of_b) };
        Ok((shadow_difference(&compared, &reference), reference))
    }

    /// Returns the decisions of a technique about all light samples.
    ///
    /// # Errors
    /// Returns an error if the device was lost.
    pub fn decisions(
        &mut self,
        gpu: &Gpu,
        scene: ComparedScene<'_>,
        settings: &ShadowSettings,
    ) -> Result<Decisions, GpuError> {
        let samples = self.with_frame(gpu, scene, |light, frame| decisions(light, frame, settings))?;
        Ok(Decisions { size: scene.size, samples })
    }

    /// Returns the stencil after the shadows of light sample `index` have been marked in it, one byte a pixel.
    ///
    /// # Errors
    /// Returns an error if the device was lost.
    pub fn stencil(
        &mut self,
        gpu: &Gpu,
        scene: ComparedScene<'_>,
        settings: &ShadowSettings,
        index: usize,
    ) -> Result<Vec<u8>, GpuError> {
        self.with_frame(gpu, scene, |light, frame| stencil(light, frame, settings, index))
    }

    fn with_frame<T>(
        &mut self,
        gpu: &Gpu,
        compared: ComparedScene<'_>,
        draw: impl FnOnce(&mut RealTimeLight, FrameContext<'_>) -> T,
    ) -> T {
        let ComparedScene { scene, shadows, view, size } = compared;
        let render_settings = &RenderSettings::default();
        let bindings = &frame_bind_group(gpu, &self.layout, scene, view, render_settings);
        let in_view = &scene.in_view(gpu, &view.cull_view(render_settings.cull_back));
        // The last call may have been for another scene.
        self.light.clear_scene();
        let frame =
            FrameContext { gpu, bindings, size, scene, in_view, shadows, view, render_settings, stopwatch: None };
        draw(&mut self.light, frame)
    }
}
