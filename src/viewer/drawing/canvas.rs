//! The picture of the scene behind the panels. It is redrawn only if something in it has changed.
//!
//! Hardware draws every picture at full detail. A software driver (lavapipe) draws sketches during a movement: one
//! sample per pixel, at half the size if the full size takes too long. When the movement has ended, it draws a picture
//! at full detail, or with one sample per pixel at the full size during a bake.

use std::sync::Arc;

use crate::gpu::stopwatch::Laps;
use crate::gpu::{Gpu, Stopwatch};
use crate::render::OverlayPass;
use crate::render::shadow::SampleBatch;
use crate::viewer::drawing::comparison::DifferenceHeatMap;
use crate::viewer::drawing::scene_renderer::SceneRenderer;
use crate::viewer::picture::content::{Detail, PictureContent};
use crate::viewer::picture::texture::{new_texture, view_of, write};
use crate::viewer::settings::comparison::{ComparedShadows, ComparisonLayout};
use crate::viewer::software::warm_up::warm_up_content;
use crate::viewer::solution::traced_view::TracedView;

/// The difference between the last picture and the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// Nothing has changed.
    None,
    /// Only the light has changed.
    Light,
    /// The view, the settings or the scene has changed.
    Content,
}

/// The last picture, and the renderers that draw the next.
pub struct Canvas {
    format: wgpu::TextureFormat,
    renderer: SceneRenderer,
    /// Draws the picture with the compared shadows; `None` unless shadows are compared.
    compared_renderer: Option<SceneRenderer>,
    heat_map: Option<DifferenceHeatMap>,
    overlay: OverlayPass,
    picture: Option<Picture>,
    watch: Option<Arc<Stopwatch>>,
    laps: Laps,
}

struct Picture {
    content: PictureContent,
    detail: Detail,
    /// The light samples that were added last.
    batch: Option<SampleBatch>,
    texture: wgpu::Texture,
    /// The last picture with the compared shadows; `None` unless the picture is split.
    beside: Option<wgpu::Texture>,
    /// Share of pixels in which the techniques disagree; `None` unless the picture is a heat map of them.
    difference: Option<f32>,
}

impl Canvas {
    /// Creates a canvas for targets of `format`.
    #[must_use]
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        Self {
            format,
            renderer: SceneRenderer::new(gpu, format),
            compared_renderer: None,
            heat_map: None,
            overlay: OverlayPass::new(gpu, format),
            picture: None,
            watch: None,
            laps: Laps::default(),
        }
    }

    /// Draws a picture that is not shown, once as a sketch and once as at rest during a bake, so that a software driver
    /// compiles its shaders.
    pub fn warm_up(&mut self, gpu: &Gpu) {
        let Some(content) = warm_up_content(gpu) else { return };
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("warm-up") });
        for detail in [Detail::Plain, Detail::Sketch] {
            self.draw(gpu, &mut encoder, content.clone(), detail, None);
        }
        gpu.queue.submit([encoder.finish()]);
        self.forget();
    }

    /// Returns what has changed in `content` since the last picture.
    #[must_use]
    pub fn change(&self, content: &PictureContent) -> Change {
        let Some(Picture { content: last, .. }) = &self.picture else { return Change::Content };
        let is_same_sight = Arc::ptr_eq(&last.scene, &content.scene)
            && last.view == content.view
            && last.settings == content.settings
            && last.compared_shadows == content.compared_shadows
            && last.overlay.as_ref().map(Arc::as_ptr) == content.overlay.as_ref().map(Arc::as_ptr)
            && last.size == content.size;
        match (is_same_sight, last.light == content.light) {
            (true, true) => Change::None,
            (true, false) => Change::Light,
            (false, _) => Change::Content,
        }
    }

    /// Returns the level of detail of the last picture; `None` if there is none.
    #[must_use]
    pub fn detail(&self) -> Option<Detail> {
        self.picture.as_ref().map(|picture| picture.detail)
    }

    /// The light samples that were added last.
    #[must_use]
    pub fn batch(&self) -> Option<SampleBatch> {
        self.picture.as_ref().and_then(|picture| picture.batch)
    }

    /// Returns the share of pixels in which the compared shadows disagree; `None` unless the picture is a heat map of
    /// them.
    #[must_use]
    pub fn difference(&self) -> Option<f32> {
        self.picture.as_ref().and_then(|picture| picture.difference)
    }

    /// Returns true if the driver draws on the CPU. Coarser levels of detail are faster there.
    #[must_use]
    pub fn is_software(&self) -> bool {
        self.renderer.is_software()
    }

    /// Returns the exposure that was metered for the last picture, stops; `None` if its exposure was fixed.
    #[must_use]
    pub fn metered_ev(&self, gpu: &Gpu) -> Option<f32> {
        self.picture.as_ref().and_then(|_| self.renderer.metered_ev(gpu))
    }

    /// Records the time of the last frame, seconds.
    pub fn note_time(&mut self, seconds: f32) {
        self.renderer.note_time(seconds);
        self.compared_renderer.iter_mut().for_each(|renderer| renderer.note_time(seconds));
    }

    /// Adds part of a batch of light samples. The picture does not change before the batch is complete.
    pub fn add_light(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        content: &PictureContent,
        batch: SampleBatch,
    ) {
        self.renderer.add_light(gpu, encoder, &content.with_batch(Some(batch)));
        if let Some(ComparedShadows { settings, .. }) = &content.compared_shadows {
            let content = content.with_shadows(settings).with_batch(Some(batch));
            self.compared_renderer(gpu).add_light(gpu, encoder, &content);
        }
        self.picture.iter_mut().for_each(|picture| picture.batch = Some(batch));
    }

    /// Draws a new picture. Light samples of a batch other than the first are added to those of the last picture.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        content: PictureContent,
        detail: Detail,
        batch: Option<SampleBatch>,
    ) {
        if content.compared_shadows.is_none() {
            // After a comparison has ended, its renderer would keep a scene and its shadow maps in memory.
            (self.compared_renderer, self.heat_map) = (None, None);
        }
        let (shown, beside) = self.textures(gpu, content.size);
        if let Some(watch) = &self.watch {
            watch.begin(encoder);
        }
        let (beside, difference) = match &content.compared_shadows {
            Some(ComparedShadows { settings, layout: ComparisonLayout::Difference }) => {
                let heat_map = self.heat_map.get_or_insert_with(|| DifferenceHeatMap::new(gpu));
                (None, heat_map.draw(gpu, &shown, &content, settings, detail))
            }
            compared => {
                self.renderer.draw(gpu, encoder, &view_of(&shown), &content.with_batch(batch), detail);
                self.draw_overlay(gpu, encoder, &shown, &content);
                let beside = compared.as_ref().map(|ComparedShadows { settings, .. }| {
                    let texture = beside.unwrap_or_else(|| new_texture(gpu, content.size, self.format));
                    let other = content.with_shadows(settings).with_batch(batch);
                    self.compared_renderer(gpu).draw(gpu, encoder, &view_of(&texture), &other, detail);
                    self.draw_overlay(gpu, encoder, &texture, &content);
                    texture
                });
                (beside, None)
            }
        };
        if let Some(watch) = &self.watch {
            watch.end(encoder);
        }
        self.picture = Some(Picture { content, detail, batch, texture: shown, beside, difference });
    }

    /// Returns textures for the next picture: those of the last one if its size is the same. The second is `None` if
    /// the last picture had none.
    fn textures(&mut self, gpu: &Gpu, size: [u32; 2]) -> (wgpu::Texture, Option<wgpu::Texture>) {
        match self.picture.take().filter(|last| last.content.size == size) {
            Some(last) => (last.texture, last.beside),
            None => (new_texture(gpu, size, self.format), None),
        }
    }

    fn compared_renderer(&mut self, gpu: &Gpu) -> &mut SceneRenderer {
        self.compared_renderer.get_or_insert_with(|| SceneRenderer::following(gpu, self.format, &self.renderer))
    }

    fn draw_overlay(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::Texture,
        content: &PictureContent,
    ) {
        if let Some(overlay) = &content.overlay {
            self.overlay.draw(gpu, encoder, &view_of(target), &content.request(), overlay);
        }
    }

    /// Drops the last picture, so that the next one is drawn in any case.
    pub fn forget(&mut self) {
        self.picture = None;
    }

    /// Switches the timing of passes on or off.
    pub fn time(&mut self, gpu: &Gpu, is_wanted: bool) {
        if is_wanted != self.watch.is_some() {
            self.watch = is_wanted.then(|| Arc::new(Stopwatch::new(gpu)));
            self.laps = Laps::default();
            self.renderer.time(self.watch.as_ref());
        }
    }

    /// Reads the times of the passes of the picture that was submitted last.
    pub fn read_watch(&mut self, gpu: &Gpu) {
        if let Some(watch) = &self.watch {
            // The next frame reports a lost device.
            self.laps = watch.read(gpu).unwrap_or_default();
        }
    }

    /// Returns the times of the passes of the last picture; empty unless passes are timed.
    #[must_use]
    pub fn laps(&self) -> &Laps {
        &self.laps
    }

    /// Replaces the pixels of the last picture by a traced view. Returns false if the sizes differ.
    pub fn show_traced(&mut self, gpu: &Gpu, traced: &TracedView) -> bool {
        let Some(picture) = self.picture.as_mut().filter(|picture| picture.content.size == traced.size) else {
            return false;
        };
        write(gpu, &picture.texture, &traced.display);
        picture.detail = Detail::Traced;
        true
    }

    /// Copies the last picture into the top left corner of `target`. In a split picture the part to the right of
    /// `divider`, a fraction of the width, has the compared shadows.
    pub fn copy_to(&self, encoder: &mut wgpu::CommandEncoder, target: &wgpu::Texture, divider: f32) {
        let Some(Picture { texture, beside, .. }) = &self.picture else { return };
        let [width, height] = [texture.width().min(target.width()), texture.height().min(target.height())];
        let column = if beside.is_some() { ((divider * width as f32) as u32).min(width) } else { width };
        for (source, from, to) in [(Some(texture), 0, column), (beside.as_ref(), column, width)] {
            let Some(source) = source.filter(|_| from < to) else { continue };
            let at = |texture| wgpu::TexelCopyTextureInfo {
                origin: wgpu::Origin3d { x: from, y: 0, z: 0 },
                ..wgpu::Texture::as_image_copy(texture)
            };
            let size = wgpu::Extent3d { width: to - from, height, depth_or_array_layers: 1 };
            encoder.copy_texture_to_texture(at(source), at(target), size);
        }
    }
}
