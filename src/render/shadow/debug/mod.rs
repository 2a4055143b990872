//! Debug views: what a shadow technique works with, drawn over the finished picture.

mod marks;
mod overlays;

use super::light_samples::LightSample;
use super::real_time::{RealTimeLight, Subject};
use super::{ShadowSettings, ShadowTechnique};
use crate::gpu::Gpu;
use crate::render::{Overlay, OverlayPass};

use marks::{Marks, Source};
use overlays::{MapOverlay, StencilOverlay};

pub use overlays::count_colour;

/// What is shown of a technique.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DebugView {
    /// What the stencil holds where light is added: in how many volumes, or under how many planar shadows, a point is.
    StencilCounts,
    /// Sides of the shadow volumes as translucent hulls.
    Volumes,
    /// Edges at which the light sees casters end.
    Silhouettes,
    /// Depth in the shadow map: near is bright, nothing is blue.
    Map,
    /// Planes that receive planar shadows, each in a colour.
    Receivers,
}

/// A debug view of one light sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShadowDebug {
    /// What is shown.
    pub view: DebugView,
    /// Number of the light sample; beyond the last counts as the last.
    pub light: usize,
}

/// Draws debug views into pictures of one format.
pub struct DebugPass {
    light: RealTimeLight,
    stencil: StencilOverlay,
    map: MapOverlay,
    overlay: OverlayPass,
    /// The last marks, and from what they were made.
    marks: Option<(Source, Overlay)>,
}

impl DebugPass {
    /// Passes for pictures of `output_format`.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout, output_format: wgpu::TextureFormat) -> Self {
        let light = RealTimeLight::new(gpu, frame_layout, 1);
        Self {
            stencil: StencilOverlay::new(gpu, output_format),
            map: MapOverlay::new(gpu, light.map_layout(), output_format),
            overlay: OverlayPass::new(gpu, output_format),
            light,
            marks: None,
        }
    }

    /// The next picture is of another scene.
    pub fn forget(&mut self) {
        self.light.forget();
        self.marks = None;
    }

    /// Draws over the picture in `target`, which is `size` pixels wide and high.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        size: [u32; 2],
        subject: Subject<'_>,
        debug: ShadowDebug,
    ) {
        let settings =
            subject.settings.shadows.clone().unwrap_or(ShadowSettings::new(ShadowTechnique::VolumeDepthFail));
        let samples = settings.samples(subject.shadows);
        let Some(last) = samples.len().checked_sub(1) else { return };
        let index = debug.light.min(last);
        match debug.view {
            DebugView::StencilCounts => {
                let settings = counting(settings);
                let stencil = self.light.count(gpu, encoder, size, subject, &settings, index);
                self.stencil.draw(gpu, encoder, target, &stencil, settings.technique);
            }
            DebugView::Map => {
                let map = self.light.map(gpu, encoder, subject, &settings, &samples[index]);
                self.map.draw(encoder, target, size, &map, &samples[index]);
            }
            DebugView::Volumes | DebugView::Silhouettes | DebugView::Receivers => {
                let marks = self.marks(gpu, subject, debug.view, &settings, &samples[index]);
                self.overlay.draw(gpu, encoder, target, size, subject.scene, subject.view, subject.settings, &marks);
                self.marks = Some((Source::new(debug.view, &settings, &samples[index]), marks));
            }
        }
    }

    fn marks(
        &mut self,
        gpu: &Gpu,
        subject: Subject<'_>,
        view: DebugView,
        settings: &ShadowSettings,
        sample: &LightSample,
    ) -> Overlay {
        let source = Source::new(view, settings, sample);
        if let Some((_, marks)) = self.marks.take_if(|(last, _)| *last == source) {
            return marks;
        }
        let Marks { lines, triangles } = Marks::of(subject.shadows, &source);
        Overlay::new(gpu, &lines, &triangles)
    }
}

/// The technique itself where it counts in the stencil, else depth-fail.
fn counting(settings: ShadowSettings) -> ShadowSettings {
    use ShadowTechnique::{Planar, VolumeDepthFail, VolumeDepthPass};
    let counts = matches!(settings.technique, Planar | VolumeDepthFail | VolumeDepthPass);
    let technique = if counts { settings.technique } else { VolumeDepthFail };
    ShadowSettings { technique, ..settings }
}
