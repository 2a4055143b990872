//! What a shadow technique does for each light sample of a picture.

use super::direct_light::DirectLightPass;
use super::sample::LightSample;
use super::sample_context::SampleContext;
use super::targets::LightTargets;
use crate::render::shadow::settings::ShadowSettings;
use crate::render::shadow::shared::frame_context::FrameContext;

/// A technique that finds the shadows of one light sample after the other on the device.
///
/// For each picture [`prepare`](Self::prepare) is called once, then for each light sample
/// [`mark_shadows`](Self::mark_shadows) with a cleared stencil and [`add_light`](Self::add_light).
pub trait ShadowPass: Send + Sync {
    /// Computes for all light samples of a picture what is needed before its first pass.
    fn prepare(&mut self, _frame: FrameContext<'_>, _settings: &ShadowSettings, _samples: &[LightSample]) {}

    /// Marks the shadows of a light sample in the stencil. Bind groups 0 and 1 are set.
    fn mark_shadows(&self, _pass: &mut wgpu::RenderPass<'_>, _sample: SampleContext<'_>) {}

    /// Whether shadows of casters with holes are missing from the stencil, so that the cut-out pass has to add them.
    fn needs_cutouts(&self) -> bool {
        false
    }

    /// Adds the irradiance of a light sample wherever it is not in shadow.
    fn add_light(&mut self, encoder: &mut wgpu::CommandEncoder, targets: &LightTargets, sample: SampleContext<'_>);

    /// Returns the pass that lights the surfaces on which the technique can show shadows, in shadow or not; `None` if
    /// these are all surfaces.
    fn receivers(&self) -> Option<&DirectLightPass> {
        None
    }

    /// Drops what is kept of the last scene.
    fn clear_scene(&mut self) {}
}
