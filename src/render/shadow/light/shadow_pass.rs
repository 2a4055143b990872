//! Interface of the shadow techniques that draw one light sample after the other.

use super::direct_light::DirectLightPass;
use super::sample::LightSample;
use super::sample_context::SampleContext;
use super::targets::LightTargets;
use crate::render::shadow::settings::ShadowSettings;
use crate::render::shadow::shared::frame_context::FrameContext;

/// A technique that finds shadows on the device, one light sample after the other.
///
/// For each picture [`prepare`](Self::prepare) is called once, then for each light sample
/// [`mark_shadows`](Self::mark_shadows) with a cleared stencil and [`add_light`](Self::add_light).
pub trait ShadowPass: Send + Sync {
    /// Prepares a picture: computes what the technique needs for all its light samples. By default there is nothing to
    /// do.
    fn prepare(&mut self, _frame: FrameContext<'_>, _settings: &ShadowSettings, _samples: &[LightSample]) {}

    /// Marks the shadows of a light sample in the stencil. Bind groups 0 and 1 are set.
    fn mark_shadows(&self, _pass: &mut wgpu::RenderPass<'_>, _sample: SampleContext<'_>) {}

    /// Returns true if the stencil lacks the shadows of casters with holes. The cut-out pass then adds them.
    fn needs_cutouts(&self) -> bool {
        false
    }

    /// Adds the irradiance of a light sample wherever it is not in shadow.
    fn add_light(&mut self, encoder: &mut wgpu::CommandEncoder, targets: &LightTargets, sample: SampleContext<'_>);

    /// Returns the pass that lights all surfaces on which the technique can show shadows, also where they are in
    /// shadow. `None` if the technique can show shadows on every surface.
    fn receivers(&self) -> Option<&DirectLightPass> {
        None
    }

    /// Drops the data that is cached for the last scene.
    fn clear_scene(&mut self) {}
}
