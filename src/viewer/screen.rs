//! The window's surface: the picture of the scene, and the panels on top of it.

use std::sync::Arc;
use std::time::{Duration, Instant};

use anyhow::Context;
use winit::dpi::PhysicalSize;
use winit::window::Window;

use super::canvas::Canvas;
use super::kept_side::KeptSide;
use super::sight::{Detail, Sight};
use super::warm_up::warm_up;
use crate::gpu::Gpu;
use crate::render::shadow::Batch;

/// Where neither picture nor panels are.
pub(super) const EMPTY: wgpu::Color = wgpu::Color { r: 0.05, g: 0.055, b: 0.065, a: 1.0 };

/// Times that a surface is set up until it is, and what is waited between: seconds in all.
const MOST_TRIES: usize = 1000;
const PAUSE: Duration = Duration::from_millis(2);

/// A device with a window's surface and what draws into it.
pub struct Screen {
    /// The window's device; the bake has its own.
    pub gpu: Arc<Gpu>,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    /// The picture behind the panels.
    pub canvas: Canvas,
    painter: egui_wgpu::Renderer,
    /// Where the processor draws.
    side: Option<KeptSide>,
}

/// A picture to draw.
pub struct NewPicture {
    /// What it shows.
    pub sight: Sight,
    /// How finely.
    pub detail: Detail,
    /// Which light samples it adds, where they come in batches.
    pub batch: Option<Batch>,
    /// More samples of the batch are to come: nothing new is shown.
    pub is_partial: bool,
}

/// Panels to draw.
pub struct PanelShapes {
    /// Triangles.
    pub primitives: Vec<egui::ClippedPrimitive>,
    /// Glyphs and pictures that are new or gone.
    pub textures: egui::TexturesDelta,
    /// Pixels of a point.
    pub pixels_per_point: f32,
    /// Where the side panel is, points; empty where it is hidden.
    pub side: egui::Rect,
    /// Where the divider of a split screen is, as a share of the picture's width.
    pub divider: f32,
}

/// What became of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// It is on the screen.
    Yes,
    /// The surface has been set up anew: draw it again.
    Retry,
    /// Nobody can see the window now.
    No,
}

impl Screen {
    /// A device that can draw into `window`, and the surface set up for it.
    ///
    /// # Errors
    /// No graphics adapter can draw into this window.
    pub fn new(window: &Arc<Window>) -> anyhow::Result<Self> {
        let display = Box::new(Arc::clone(window));
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_with_display_handle_from_env(display));
        let surface = instance.create_surface(Arc::clone(window)).context("the window takes no graphics")?;
        let gpu = Gpu::for_surface(instance, Some(&surface))?;
        let config = configuration(&gpu, &surface, window.inner_size())?;
        configure(&gpu, &surface, &config);
        let mut canvas = Canvas::new(&gpu, config.format);
        if canvas.is_slow() {
            warm_up(&gpu, &mut canvas);
        }
        // Plain panels need no dithering, which costs a processor that draws more than the panels themselves.
        let options = egui_wgpu::RendererOptions { dithering: false, ..Default::default() };
        let painter = egui_wgpu::Renderer::new(&gpu.device, config.format, options);
        let side = canvas.is_slow().then(KeptSide::default);
        Ok(Self { gpu: Arc::new(gpu), surface, config, canvas, painter, side })
    }

    /// Pixels across and down.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        [self.config.width, self.config.height]
    }

    /// Follows the window's size; an empty window keeps the last one.
    pub fn resize(&mut self, size: PhysicalSize<u32>) {
        let limit = self.gpu.device.limits().max_texture_dimension_2d;
        if size.width > 0 && size.height > 0 {
            (self.config.width, self.config.height) = (size.width.min(limit), size.height.min(limit));
            configure(&self.gpu, &self.surface, &self.config);
        }
    }

    /// Draws a frame and shows it: a new picture where one is given, else the last one, and the panels on top.
    pub fn show(&mut self, window: &Window, picture: Option<NewPicture>, mut panels: PanelShapes) -> Shown {
        // Even where the frame fails: panels say only once what is new and what is gone.
        self.update_textures(&panels.textures);
        let shown = self.show_updated(window, picture, &mut panels);
        for id in &panels.textures.free {
            self.painter.free_texture(id);
        }
        panels.textures.clear();
        shown
    }

    fn show_updated(&mut self, window: &Window, picture: Option<NewPicture>, panels: &mut PanelShapes) -> Shown {
        let frame = match self.surface.get_current_texture() {
            wgpu::CurrentSurfaceTexture::Success(frame) | wgpu::CurrentSurfaceTexture::Suboptimal(frame) => frame,
            wgpu::CurrentSurfaceTexture::Timeout | wgpu::CurrentSurfaceTexture::Occluded => return Shown::No,
            wgpu::CurrentSurfaceTexture::Outdated
            | wgpu::CurrentSurfaceTexture::Lost
            | wgpu::CurrentSurfaceTexture::Validation => {
                configure(&self.gpu, &self.surface, &self.config);
                return Shown::Retry;
            }
        };
        // Pictures that go on from others take less than their own time.
        let is_whole = picture.as_ref().is_some_and(|picture| picture.batch.is_none_or(Batch::is_first));
        let begun = Instant::now();
        self.submit(&frame.texture, picture, panels);
        if is_whole {
            self.canvas.read_watch(&self.gpu);
        }
        if self.gpu.is_software() {
            // The cores draw now: the bake shall not take them away before the frame is whole.
            let _ = self.gpu.device.poll(wgpu::PollType::wait_indefinitely());
            if is_whole {
                self.canvas.note_time(begun.elapsed().as_secs_f32());
            }
        }
        window.pre_present_notify();
        self.gpu.queue.present(frame);
        Shown::Yes
    }

    fn submit(&mut self, target: &wgpu::Texture, picture: Option<NewPicture>, panels: &mut PanelShapes) {
        let Gpu { device, queue, .. } = &*self.gpu;
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("screen") });
        match picture {
            Some(NewPicture { sight, batch: Some(batch), is_partial: true, .. }) => {
                self.canvas.add_light(&self.gpu, &mut encoder, &sight, batch);
            }
            Some(NewPicture { sight, detail, batch, .. }) => {
                self.canvas.draw(&self.gpu, &mut encoder, sight, detail, batch);
            }
            None => {}
        }
        let view = target.create_view(&wgpu::TextureViewDescriptor::default());
        drop(begin_pass(&mut encoder, &view, wgpu::LoadOp::Clear(EMPTY)));
        self.canvas.paste(&mut encoder, target, panels.divider);
        let screen =
            egui_wgpu::ScreenDescriptor { size_in_pixels: self.size(), pixels_per_point: panels.pixels_per_point };
        let mut uploads = self.painter.update_buffers(device, queue, &mut encoder, &panels.primitives, &screen);
        if let Some(side) = &mut self.side {
            side.paint(&self.gpu, &mut encoder, &self.painter, target, panels);
        } else {
            let mut pass = begin_pass(&mut encoder, &view, wgpu::LoadOp::Load).forget_lifetime();
            self.painter.render(&mut pass, &panels.primitives, &screen);
        }
        uploads.push(encoder.finish());
        queue.submit(uploads);
    }

    fn update_textures(&mut self, textures: &egui::TexturesDelta) {
        for (&id, deltas) in &textures.set {
            for delta in deltas {
                self.painter.update_texture(&self.gpu.device, &self.gpu.queue, id, delta);
            }
        }
    }
}

/// Sets a surface up. wgpu refuses where another thread hands work to the device just then, as a bake does with its light:
/// once more.
fn configure(gpu: &Gpu, surface: &wgpu::Surface<'_>, config: &wgpu::SurfaceConfiguration) {
    for _ in 0..MOST_TRIES {
        let refusal = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
        surface.configure(&gpu.device, config);
        if pollster::block_on(refusal.pop()).is_none() {
            return;
        }
        std::thread::sleep(PAUSE);
    }
}

/// Begins a pass of panels.
pub(super) fn begin_pass<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    target: &wgpu::TextureView,
    load: wgpu::LoadOp<wgpu::Color>,
) -> wgpu::RenderPass<'e> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("panels"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: target,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
        })],
        ..Default::default()
    })
}

/// Keeps time with the screen. The format stores what it is given: picture and panels encode sRGB themselves, and
/// panels blend in that space.
fn configuration(
    gpu: &Gpu,
    surface: &wgpu::Surface<'_>,
    size: PhysicalSize<u32>,
) -> anyhow::Result<wgpu::SurfaceConfiguration> {
    let config = surface.get_default_config(&gpu.adapter, size.width.max(1), size.height.max(1));
    let mut config = config.with_context(|| format!("{} cannot draw into this window", gpu.name()))?;
    let formats = surface.get_capabilities(&gpu.adapter).formats;
    // Pictures are copied into the surface.
    config.usage |= wgpu::TextureUsages::COPY_DST;
    let is_plain = |format: &&wgpu::TextureFormat| {
        matches!(format, wgpu::TextureFormat::Bgra8Unorm | wgpu::TextureFormat::Rgba8Unorm)
    };
    if let Some(&plain) = formats.iter().find(is_plain) {
        config.format = plain;
    }
    config.present_mode = wgpu::PresentMode::AutoVsync;
    Ok(config)
}
