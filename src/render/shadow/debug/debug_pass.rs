//! Draws the debug view of a picture.

use super::map_faces::MapFaces;
use super::marks::{Marks, MarksKey};
use super::stencil_counts::StencilCounts;
use super::view::{DebugView, ShadowDebug};
use crate::gpu::Gpu;
use crate::render::shadow::map::shadow_map::ShadowMapPass;
use crate::render::shadow::real_time::RealTimeLight;
use crate::render::shadow::settings::ShadowSettings;
use crate::render::shadow::shared::frame_context::FrameContext;
use crate::render::shadow::technique::ShadowTechnique;
use crate::render::{MeteredExposure, Overlay, OverlayPass, PictureRequest};

/// Draws debug views into pictures of one format.
pub struct DebugPass {
    light: RealTimeLight,
    stencil_counts: StencilCounts,
    maps: ShadowMapPass,
    map_faces: MapFaces,
    overlay: OverlayPass,
    /// The last marks, and the key that they were made from.
    marks: Option<(MarksKey, Overlay)>,
}

impl DebugPass {
    /// Creates passes for pictures of `output_format`.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout, output_format: wgpu::TextureFormat) -> Self {
        let maps = ShadowMapPass::new(gpu);
        Self {
            light: RealTimeLight::new(gpu, frame_layout, 1),
            stencil_counts: StencilCounts::new(gpu, output_format),
            map_faces: MapFaces::new(gpu, maps.read_layout(), output_format),
            maps,
            overlay: OverlayPass::new(gpu, output_format),
            marks: None,
        }
    }

    /// Drops the data that is cached for the last scene.
    pub fn clear_scene(&mut self) {
        self.light.clear_scene();
        self.marks = None;
    }

    /// Draws the debug view over the picture in `target`.
    pub fn draw(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        frame: FrameContext<'_>,
        debug: ShadowDebug,
    ) {
        let depth_fail = || ShadowSettings::new(ShadowTechnique::VolumeDepthFail);
        let settings = frame.render_settings.shadows.clone().unwrap_or_else(depth_fail);
        let samples = settings.samples(frame.shadows);
        let Some(last) = samples.len().checked_sub(1) else { return };
        let index = debug.light.min(last);
        match debug.view {
            DebugView::StencilCounts => self.draw_stencil_counts(encoder, target, frame, settings, index),
            DebugView::Map => {
                let map = self.maps.map(encoder, frame, &samples[index], &settings.maps);
                let bindings = self.maps.bind(frame.gpu, &map);
                self.map_faces.draw(encoder, target, frame.size, (map.num_faces, &bindings), &samples[index]);
            }
            DebugView::Volumes | DebugView::Silhouettes | DebugView::Receivers => {
                self.draw_marks(encoder, target, frame, MarksKey::new(debug.view, &settings, &samples[index]));
            }
        }
    }

    /// Draws the stencil counts of the technique, or those of depth-fail if the technique does not use the stencil.
    fn draw_stencil_counts(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        frame: FrameContext<'_>,
        mut settings: ShadowSettings,
        index: usize,
    ) {
        if settings.technique.info().counted_bits.is_none() {
            settings.technique = ShadowTechnique::VolumeDepthFail;
        }
        let run = self.light.prepare(frame, &settings);
        self.light.draw_depth(encoder, &run);
        self.light.mark_shadows(encoder, &run, index);
        let stencil = run.targets.depth_stencil_texture.create_view(&wgpu::TextureViewDescriptor {
            aspect: wgpu::TextureAspect::StencilOnly,
            ..Default::default()
        });
        self.light.keep_targets(run);
        let bits = settings.technique.info().counted_bits.unwrap_or(u32::MAX);
        self.stencil_counts.draw(frame.gpu, encoder, target, &stencil, bits);
    }

    fn draw_marks(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        frame: FrameContext<'_>,
        key: MarksKey,
    ) {
        let kept = self.marks.take_if(|(last, _)| *last == key);
        let (_, marks) = self.marks.insert(kept.unwrap_or_else(|| {
            let Marks { lines, triangles } = Marks::new(frame.shadows, &key);
            (key, Overlay::new(frame.gpu, &lines, &triangles))
        }));
        let FrameContext { gpu, size, scene, view, render_settings: settings, .. } = frame;
        let exposure = MeteredExposure::OfThis;
        let request = PictureRequest { size, scene, shadows: None, view: *view, settings, exposure, stopwatch: None };
        self.overlay.draw(gpu, encoder, target, &request, marks);
    }
}
