//! The picture of the scene behind the panels, drawn anew only where something in it has changed.
//!
//! A graphics card draws every picture finely. Where the processor draws (lavapipe), a picture that follows a movement
//! is a sketch with one sample a pixel, of half the size where that takes too long, and is drawn out when the movement rests.

use std::sync::Arc;

use super::difference::Differ;
use super::painter::{Painter, texture, view_of};
use super::sight::{Comparison, Detail, Rival, Sight};
use super::still::Exposed;
use crate::gpu::stopwatch::Laps;
use crate::gpu::{Gpu, Stopwatch};
use crate::render::shadow::Batch;
use crate::render::{OverlayPass, RenderSettings, ShadowSettings};

/// What has changed since the last picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// Nothing.
    None,
    /// Only the light has been renewed.
    Light,
    /// The eye, the settings or the scene.
    Sight,
}

/// The last picture and what draws the next.
pub struct Canvas {
    format: wgpu::TextureFormat,
    painter: Painter,
    /// Draws what the settings are compared with; made when that is first asked for.
    rival: Option<Painter>,
    differ: Option<Differ>,
    overlay: OverlayPass,
    picture: Option<Picture>,
    watch: Option<Arc<Stopwatch>>,
    laps: Laps,
}

struct Picture {
    sight: Sight,
    detail: Detail,
    /// The last light samples that were added.
    batch: Option<Batch>,
    texture: wgpu::Texture,
    /// The same with the shadows of the rival.
    beside: Option<wgpu::Texture>,
    /// Share of pixels in which both decide differently, where that is shown.
    difference: Option<f32>,
}

impl Canvas {
    /// A canvas for targets of `format`.
    #[must_use]
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        Self {
            format,
            painter: Painter::new(gpu, format),
            rival: None,
            differ: None,
            overlay: OverlayPass::new(gpu, format),
            picture: None,
            watch: None,
            laps: Laps::default(),
        }
    }

    /// What `sight` shows anew.
    #[must_use]
    pub fn change(&self, sight: &Sight) -> Change {
        let Some(Picture { sight: last, .. }) = &self.picture else { return Change::Sight };
        let is_same_sight = Arc::ptr_eq(&last.scene, &sight.scene)
            && last.view == sight.view
            && last.settings == sight.settings
            && last.rival == sight.rival
            && last.overlay.as_ref().map(Arc::as_ptr) == sight.overlay.as_ref().map(Arc::as_ptr)
            && last.size == sight.size;
        match (is_same_sight, last.light == sight.light) {
            (true, true) => Change::None,
            (true, false) => Change::Light,
            (false, _) => Change::Sight,
        }
    }

    /// How finely the last picture was drawn; none where there is none.
    #[must_use]
    pub fn detail(&self) -> Option<Detail> {
        self.picture.as_ref().map(|picture| picture.detail)
    }

    /// The light samples that were added last.
    #[must_use]
    pub fn batch(&self) -> Option<Batch> {
        self.picture.as_ref().and_then(|picture| picture.batch)
    }

    /// Share of pixels in which the compared shadows differ, where the picture shows that.
    #[must_use]
    pub fn difference(&self) -> Option<f32> {
        self.picture.as_ref().and_then(|picture| picture.difference)
    }

    /// The processor draws, and details cost time.
    #[must_use]
    pub fn is_slow(&self) -> bool {
        self.painter.is_slow()
    }

    /// The exposure that was metered for the last picture, stops; none where none was metered.
    #[must_use]
    pub fn metered_ev(&self, gpu: &Gpu) -> Option<f32> {
        self.picture.as_ref().and_then(|_| self.painter.metered_ev(gpu))
    }

    /// The picture that was drawn last took the processor so long, with the panels, seconds.
    pub fn note_time(&mut self, seconds: f32) {
        self.painter.note_time(seconds);
        self.rival.iter_mut().for_each(|rival| rival.note_time(seconds));
    }

    /// Adds part of a batch of light samples; the picture stays as it is until the batch is whole.
    pub fn add_light(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, sight: &Sight, batch: Batch) {
        self.painter.add_light(gpu, encoder, sight, &in_batch(&sight.settings, Some(batch)));
        if let Some(Rival { settings, .. }) = &sight.rival {
            let render_settings = RenderSettings { shadows: Some(settings.clone()), ..sight.settings.clone() };
            self.painter_of_rival(gpu).add_light(gpu, encoder, sight, &in_batch(&render_settings, Some(batch)));
        }
        self.picture.iter_mut().for_each(|picture| picture.batch = Some(batch));
    }

    /// Draws a new picture; light samples of a batch that is not the first are added to the last picture's.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        sight: Sight,
        detail: Detail,
        batch: Option<Batch>,
    ) {
        if sight.rival.is_none() {
            // What is compared with no longer would keep a scene and the maps of its shadows.
            (self.rival, self.differ) = (None, None);
        }
        let last = self.picture.take().filter(|last| last.sight.size == sight.size);
        let (texture_of_last, beside_of_last) = last.map_or((None, None), |last| (Some(last.texture), last.beside));
        let format = self.format;
        let new_texture = || texture(gpu, sight.size, format);
        let (shown, mut beside, mut difference) = (texture_of_last.unwrap_or_else(new_texture), None, None);
        if let Some(watch) = &self.watch {
            watch.begin(encoder);
        }
        match &sight.rival {
            Some(Rival { settings, comparison: Comparison::Difference }) => {
                difference =
                    self.differ.get_or_insert_with(|| Differ::new(gpu)).draw(gpu, &shown, &sight, settings, detail);
            }
            rival => {
                self.painter.draw(gpu, encoder, &view_of(&shown), &sight, &in_batch(&sight.settings, batch), detail);
                self.draw_overlay(gpu, encoder, &shown, &sight);
                if let Some(Rival { settings, .. }) = rival {
                    let texture = beside_of_last.unwrap_or_else(new_texture);
                    let render_settings = RenderSettings { shadows: Some(settings.clone()), ..sight.settings.clone() };
                    self.painter_of_rival(gpu).draw(
                        gpu,
                        encoder,
                        &view_of(&texture),
                        &sight,
                        &in_batch(&render_settings, batch),
                        detail,
                    );
                    self.draw_overlay(gpu, encoder, &texture, &sight);
                    beside = Some(texture);
                }
            }
        }
        if let Some(watch) = &self.watch {
            watch.end(encoder);
        }
        self.picture = Some(Picture { sight, detail, batch, texture: shown, beside, difference });
    }

    fn painter_of_rival(&mut self, gpu: &Gpu) -> &mut Painter {
        self.rival.get_or_insert_with(|| {
            let mut rival = Painter::new(gpu, self.format);
            rival.follow_exposure(&self.painter);
            rival
        })
    }

    fn draw_overlay(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::Texture,
        Sight { scene, view, settings: render_settings, size, overlay, .. }: &Sight,
    ) {
        if let Some(overlay) = overlay {
            self.overlay.draw(gpu, encoder, &view_of(target), *size, scene, view, render_settings, overlay);
        }
    }

    /// The next picture is drawn whatever has changed.
    pub fn forget(&mut self) {
        self.picture = None;
    }

    /// Times passes from now on, or no longer.
    pub fn time(&mut self, gpu: &Gpu, is_wanted: bool) {
        if is_wanted != self.watch.is_some() {
            self.watch = is_wanted.then(|| Arc::new(Stopwatch::new(gpu)));
            self.laps = Laps::default();
            self.painter.time(self.watch.as_ref());
        }
    }

    /// Reads the times of the picture that was submitted last.
    pub fn read_watch(&mut self, gpu: &Gpu) {
        if let Some(watch) = &self.watch {
            // A lost device is told by the next frame.
            self.laps = watch.read(gpu).unwrap_or_default();
        }
    }

    /// What passes have taken, where they are timed.
    #[must_use]
    pub fn laps(&self) -> &Laps {
        &self.laps
    }

    /// Lays a traced picture over the last one; false where it has another size by now.
    pub fn lay(&mut self, gpu: &Gpu, exposed: &Exposed) -> bool {
        let Some(picture) = self.picture.as_mut().filter(|picture| picture.sight.size == exposed.size) else {
            return false;
        };
        write(gpu, &picture.texture, &exposed.display);
        picture.detail = Detail::Traced;
        true
    }

    /// Lays the last picture into the top left corner of `target`; what is right of `divider`, a share of the width,
    /// shows the rival's shadows where there is one.
    pub fn paste(&self, encoder: &mut wgpu::CommandEncoder, target: &wgpu::Texture, divider: f32) {
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

fn in_batch(render_settings: &RenderSettings, batch: Option<Batch>) -> RenderSettings {
    let shadows = render_settings.shadows.clone().map(|shadows| ShadowSettings { batch, ..shadows });
    RenderSettings { shadows, ..render_settings.clone() }
}

/// Writes a whole picture of RGBA bytes into a texture.
pub fn write(gpu: &Gpu, texture: &wgpu::Texture, display: &[u8]) {
    let is_bgra = matches!(texture.format(), wgpu::TextureFormat::Bgra8Unorm | wgpu::TextureFormat::Bgra8UnormSrgb);
    let swapped: Vec<u8>;
    let bytes = if is_bgra {
        swapped = display.as_chunks::<4>().0.iter().flat_map(|&[r, g, b, a]| [b, g, r, a]).collect();
        &swapped
    } else {
        display
    };
    let (width, height) = (texture.width(), texture.height());
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * width), rows_per_image: None };
    let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    gpu.queue.write_texture(texture.as_image_copy(), bytes, layout, size);
}
