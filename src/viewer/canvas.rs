//! The picture of the scene behind the panels, drawn anew only where something in it has changed.
//!
//! A graphics card draws every picture finely. Where the processor draws (lavapipe), a picture that follows a movement
//! is a sketch of half the size, and is drawn out when the movement rests: frames come five times as soon.

use std::sync::Arc;

use wgpu::util::{TextureBlitter, TextureBlitterBuilder};

use crate::gpu::{Gpu, SceneBuffers};
use crate::render::{Look, Renderer, View};

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
}

/// Everything that a picture depends on.
#[derive(Clone)]
pub struct Sight {
    /// What is seen.
    pub scene: Arc<SceneBuffers>,
    /// Counts how often the light of `scene` was renewed.
    pub light: u32,
    /// From where.
    pub view: View,
    /// How it is shown.
    pub look: Look,
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
    fine: Renderer,
    /// Where the processor draws.
    plain: Option<Renderer>,
    format: wgpu::TextureFormat,
    blitter: TextureBlitter,
    picture: Option<Picture>,
}

struct Picture {
    sight: Sight,
    detail: Detail,
    size: [u32; 2],
    view: wgpu::TextureView,
}

impl Canvas {
    /// A canvas for targets of `format`.
    #[must_use]
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        Self {
            fine: Renderer::new(gpu, format, SAMPLES),
            plain: gpu.is_software().then(|| Renderer::new(gpu, format, 1)),
            format,
            blitter: TextureBlitterBuilder::new(&gpu.device, format).sample_type(wgpu::FilterMode::Linear).build(),
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
        self.plain.is_some()
    }

    /// Draws a new picture.
    pub fn draw(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, sight: Sight, detail: Detail) {
        let size = match detail {
            Detail::Sketch => sight.size.map(|side| side.div_ceil(2)),
            Detail::Plain | Detail::Fine => sight.size,
        };
        let view = match self.picture.take() {
            Some(last) if last.size == size => last.view,
            _ => picture_view(gpu, size, self.format),
        };
        let renderer = match (&mut self.plain, detail) {
            (Some(plain), Detail::Sketch | Detail::Plain) => plain,
            _ => &mut self.fine,
        };
        renderer.draw(gpu, encoder, &view, size, &sight.scene, &sight.view, &sight.look);
        self.picture = Some(Picture { sight, detail, size, view });
    }

    /// Fills `target` with the last picture; false where there is none.
    pub fn paste(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, target: &wgpu::TextureView) -> bool {
        if let Some(picture) = &self.picture {
            self.blitter.copy(&gpu.device, encoder, &picture.view, target);
        }
        self.picture.is_some()
    }
}

fn picture_view(gpu: &Gpu, size: [u32; 2], format: wgpu::TextureFormat) -> wgpu::TextureView {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("picture"),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
