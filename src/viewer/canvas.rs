//! The picture of the scene behind the panels, drawn anew only where something in it has changed.
//!
//! A graphics card draws every picture finely. Where the processor draws (lavapipe), a picture that follows a movement
//! is a sketch of half the size, and is drawn out when the movement rests: frames come five times as soon.

use std::sync::Arc;

use wgpu::util::{TextureBlitter, TextureBlitterBuilder};

use super::still::Exposed;
use crate::gpu::{Gpu, SceneBuffers};
use crate::render::{Look, Overlay, OverlayPass, Renderer, ShadowScene, View};

/// Samples a pixel of a fine picture.
pub const SAMPLES: u32 = 4;

/// How finely a picture is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Detail {
    /// Half the size, for movement.
    Sketch,
    /// One sample a pixel, for a rest while the bake needs the processor.
    Plain,
    /// Several samples a pixel.
    Fine,
    /// Traced by rays.
    Traced,
}

/// Everything that a picture depends on.
#[derive(Clone)]
pub struct Sight {
    /// What is seen.
    pub scene: Arc<SceneBuffers>,
    /// Its casters and lights.
    pub shadows: Arc<ShadowScene>,
    /// Counts how often the light of `scene` was renewed.
    pub light: u32,
    /// From where.
    pub view: View,
    /// How it is shown.
    pub look: Look,
    /// What is drawn over it.
    pub overlay: Option<Arc<Overlay>>,
    /// Pixels across and down.
    pub size: [u32; 2],
}

/// What has changed since the last picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// Nothing.
    None,
    /// Only the light has been renewed.
    Light,
    /// The eye, the look or the scene.
    Sight,
}

/// The last picture and what draws the next.
pub struct Canvas {
    format: wgpu::TextureFormat,
    fine: Renderer,
    quick: Option<Quick>,
    overlay: OverlayPass,
    picture: Option<Picture>,
}

/// Where the processor draws.
struct Quick {
    renderer: Renderer,
    /// Enlarges sketches.
    blitter: TextureBlitter,
    /// The last sketch's target and its size.
    target: Option<(wgpu::TextureView, [u32; 2])>,
}

struct Picture {
    sight: Sight,
    detail: Detail,
    texture: wgpu::Texture,
}

impl Canvas {
    /// A canvas for targets of `format`.
    #[must_use]
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        let quick = || Quick {
            renderer: Renderer::new(gpu, format, 1),
            blitter: TextureBlitterBuilder::new(&gpu.device, format).sample_type(wgpu::FilterMode::Linear).build(),
            target: None,
        };
        Self {
            format,
            fine: Renderer::new(gpu, format, SAMPLES),
            quick: gpu.is_software().then(quick),
            overlay: OverlayPass::new(gpu, format),
            picture: None,
        }
    }

    /// What `sight` shows anew.
    #[must_use]
    pub fn change(&self, sight: &Sight) -> Change {
        let Some(Picture { sight: last, .. }) = &self.picture else { return Change::Sight };
        let is_same_sight = Arc::ptr_eq(&last.scene, &sight.scene)
            && last.view == sight.view
            && last.look == sight.look
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

    /// The processor draws, and details cost time.
    #[must_use]
    pub fn is_slow(&self) -> bool {
        self.quick.is_some()
    }

    /// The exposure that was metered for the last picture, stops; none where none was metered.
    #[must_use]
    pub fn metered_ev(&self, gpu: &Gpu) -> Option<f32> {
        let renderer = match (&self.quick, self.detail()?) {
            (Some(quick), Detail::Sketch | Detail::Plain) => &quick.renderer,
            _ => &self.fine,
        };
        // A lost device is told by the next frame.
        renderer.metered_ev(gpu).ok().flatten()
    }

    /// Draws a new picture.
    pub fn draw(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, sight: Sight, detail: Detail) {
        let texture = match self.picture.take() {
            Some(last) if last.sight.size == sight.size => last.texture,
            _ => texture(gpu, sight.size, self.format),
        };
        let target = view_of(&texture);
        let Sight { scene, view, look, size, .. } = &sight;
        self.cast_shadows(&sight.shadows);
        match (&mut self.quick, detail) {
            (Some(quick), Detail::Sketch) => quick.sketch(gpu, encoder, &target, self.format, &sight),
            (Some(quick), Detail::Plain) => quick.renderer.draw(gpu, encoder, &target, *size, scene, view, look),
            _ => self.fine.draw(gpu, encoder, &target, *size, scene, view, look),
        }
        if let Some(overlay) = &sight.overlay {
            self.overlay.draw(gpu, encoder, &target, *size, scene, view, look, overlay);
        }
        self.picture = Some(Picture { sight, detail, texture });
    }

    /// The next picture is drawn whatever has changed.
    pub fn forget(&mut self) {
        self.picture = None;
    }

    /// Lays a traced picture over the last one; false where it has another size by now.
    pub fn lay(&mut self, gpu: &Gpu, exposed: &Exposed) -> bool {
        let Some(picture) = self.picture.as_mut().filter(|picture| picture.sight.size == exposed.size) else {
            return false;
        };
        let is_bgra = matches!(self.format, wgpu::TextureFormat::Bgra8Unorm | wgpu::TextureFormat::Bgra8UnormSrgb);
        let bytes: Vec<u8> = if is_bgra {
            exposed.display.as_chunks::<4>().0.iter().flat_map(|&[r, g, b, a]| [b, g, r, a]).collect()
        } else {
            exposed.display.clone()
        };
        let [width, height] = exposed.size;
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * width), rows_per_image: None };
        gpu.queue.write_texture(
            picture.texture.as_image_copy(),
            &bytes,
            layout,
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        picture.detail = Detail::Traced;
        true
    }

    fn cast_shadows(&mut self, shadows: &Arc<ShadowScene>) {
        let quick = self.quick.as_mut().map(|quick| &mut quick.renderer);
        for renderer in [Some(&mut self.fine), quick].into_iter().flatten() {
            renderer.cast_shadows(Some(Arc::clone(shadows)));
        }
    }

    /// Lays the last picture into the top left corner of `target`.
    pub fn paste(&self, encoder: &mut wgpu::CommandEncoder, target: &wgpu::Texture) {
        let Some(Picture { texture, .. }) = &self.picture else { return };
        let size = wgpu::Extent3d {
            width: texture.width().min(target.width()),
            height: texture.height().min(target.height()),
            depth_or_array_layers: 1,
        };
        encoder.copy_texture_to_texture(texture.as_image_copy(), target.as_image_copy(), size);
    }
}

impl Quick {
    /// Draws half as wide and high, and enlarges into `target`.
    fn sketch(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        format: wgpu::TextureFormat,
        sight: &Sight,
    ) {
        let size = sight.size.map(|side| side.div_ceil(2));
        let (small, _) = match self.target.take() {
            Some(last) if last.1 == size => self.target.insert(last),
            _ => self.target.insert((view_of(&texture(gpu, size, format)), size)),
        };
        self.renderer.draw(gpu, encoder, small, size, &sight.scene, &sight.view, &sight.look);
        self.blitter.copy(&gpu.device, encoder, small, target);
    }
}

fn texture(gpu: &Gpu, size: [u32; 2], format: wgpu::TextureFormat) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("picture"),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC
            | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

fn view_of(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
