//! The surface of the window: the picture of the scene, and the panels on top of it.

use std::sync::Arc;
use std::time::{Duration, Instant};

use anyhow::Context;
use winit::dpi::PhysicalSize;
use winit::window::Window;

use crate::gpu::Gpu;
use crate::render::shadow::SampleBatch;
use crate::viewer::drawing::canvas::Canvas;
use crate::viewer::panels::shapes::{EMPTY, PanelShapes, begin_pass};
use crate::viewer::picture::content::NextPicture;
use crate::viewer::software::kept_side::KeptSide;

/// Largest number of attempts to configure the surface.
const MAX_ATTEMPTS: usize = 1000;
/// Pause between two attempts.
const PAUSE: Duration = Duration::from_millis(2);

/// The device and surface of the window, and the renderers that draw into it.
pub struct WindowSurface {
    /// The window's device; a bake has another one.
    pub gpu: Arc<Gpu>,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    /// The picture behind the panels.
    pub canvas: Canvas,
    panel_renderer: egui_wgpu::Renderer,
    /// Cached pixels of the side panel on a software driver; `None` on hardware.
    side: Option<KeptSide>,
}

/// The outcome of a frame.
#[derive(Debug)]
pub enum FrameOutcome {
    /// The frame is on the screen.
    Presented,
    /// The surface has been configured again, so the frame has to be drawn again.
    Retry,
    /// The window is not visible.
    Hidden,
    /// The device is lost, or the surface cannot be configured.
    Failed(anyhow::Error),
}

impl WindowSurface {
    /// Opens a device that can draw into `window`, and configures the surface.
    ///
    /// # Errors
    /// Returns an error if no graphics adapter can draw into the window.
    pub fn new(window: &Arc<Window>) -> anyhow::Result<Self> {
        let display = Box::new(Arc::clone(window));
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_with_display_handle_from_env(display));
        let surface = instance.create_surface(Arc::clone(window)).context("the window takes no graphics")?;
        let gpu = Gpu::for_surface(instance, Some(&surface))?;
        let config = configuration(&gpu, &surface, window.inner_size())?;
        configure(&gpu, &surface, &config)?;
        let canvas = new_canvas(&gpu, config.format);
        // Panels of plain colours need no dithering. On a software driver it would take longer than the panels
        // themselves.
        let options = egui_wgpu::RendererOptions { dithering: false, ..Default::default() };
        let panel_renderer = egui_wgpu::Renderer::new(&gpu.device, config.format, options);
        let side = canvas.is_software().then(KeptSide::default);
        Ok(Self { gpu: Arc::new(gpu), surface, config, canvas, panel_renderer, side })
    }

    /// Pixels across and down.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        [self.config.width, self.config.height]
    }

    /// Sets the size; an empty one is ignored.
    ///
    /// # Errors
    /// Returns an error if the surface cannot be configured for this size.
    pub fn resize(&mut self, size: PhysicalSize<u32>) -> anyhow::Result<()> {
        let limit = self.gpu.device.limits().max_texture_dimension_2d;
        if size.width > 0 && size.height > 0 {
            (self.config.width, self.config.height) = (size.width.min(limit), size.height.min(limit));
            configure(&self.gpu, &self.surface, &self.config)?;
        }
        Ok(())
    }

    /// Rebuilds everything that draws the picture from the current shaders.
    pub fn renew_canvas(&mut self) {
        self.canvas = new_canvas(&self.gpu, self.config.format);
    }

    /// Draws and presents a frame: the new picture, or the last one if `picture` is `None`, and the panels on top.
    pub fn present(&mut self, window: &Window, picture: Option<NextPicture>, mut panels: PanelShapes) -> FrameOutcome {
        // egui reports each change of a texture only once, so textures are updated even if the frame fails.
        self.update_textures(&panels.textures);
        let outcome = self.present_updated(window, picture, &mut panels);
        for id in &panels.textures.free {
            self.panel_renderer.free_texture(id);
        }
        panels.textures.clear();
        outcome
    }

    fn present_updated(
        &mut self,
        window: &Window,
        picture: Option<NextPicture>,
        panels: &mut PanelShapes,
    ) -> FrameOutcome {
        if let Err(error) = self.gpu.check() {
            return FrameOutcome::Failed(error.into());
        }
        let frame = match self.surface.get_current_texture() {
            wgpu::CurrentSurfaceTexture::Success(frame) | wgpu::CurrentSurfaceTexture::Suboptimal(frame) => frame,
            wgpu::CurrentSurfaceTexture::Timeout | wgpu::CurrentSurfaceTexture::Occluded => {
                return FrameOutcome::Hidden;
            }
            wgpu::CurrentSurfaceTexture::Outdated
            | wgpu::CurrentSurfaceTexture::Lost
            | wgpu::CurrentSurfaceTexture::Validation => {
                return match configure(&self.gpu, &self.surface, &self.config) {
                    Ok(()) => FrameOutcome::Retry,
                    Err(error) => FrameOutcome::Failed(error),
                };
            }
        };
        // A picture that adds to the last one takes less time than a whole picture.
        let is_whole = picture.as_ref().is_some_and(|picture| picture.batch.is_none_or(SampleBatch::is_first));
        let began = Instant::now();
        self.submit(&frame.texture, picture, panels);
        if is_whole {
            self.canvas.read_watch(&self.gpu);
        }
        if self.gpu.tier.is_software() {
            // A software driver draws on the CPU: the bake must not resume before the frame is complete.
            if let Err(error) = self.gpu.wait() {
                return FrameOutcome::Failed(error.into());
            }
            if is_whole {
                self.canvas.note_time(began.elapsed().as_secs_f32());
            }
        }
        window.pre_present_notify();
        self.gpu.queue.present(frame);
        FrameOutcome::Presented
    }

    fn submit(&mut self, target: &wgpu::Texture, picture: Option<NextPicture>, panels: &mut PanelShapes) {
        let Gpu { device, queue, .. } = &*self.gpu;
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("screen") });
        match picture {
            Some(NextPicture { content, batch: Some(batch), is_partial: true, .. }) => {
                self.canvas.add_light(&self.gpu, &mut encoder, &content, batch);
            }
            Some(NextPicture { content, detail, batch, .. }) => {
                self.canvas.draw(&self.gpu, &mut encoder, content, detail, batch);
            }
            None => {}
        }
        let view = target.create_view(&wgpu::TextureViewDescriptor::default());
        drop(begin_pass(&mut encoder, &view, wgpu::LoadOp::Clear(EMPTY)));
        self.canvas.copy_to(&mut encoder, target, panels.divider);
        let screen =
            egui_wgpu::ScreenDescriptor { size_in_pixels: self.size(), pixels_per_point: panels.pixels_per_point };
        let mut uploads = self.panel_renderer.update_buffers(device, queue, &mut encoder, &panels.primitives, &screen);
        if let Some(side) = &mut self.side {
            side.paint(&self.gpu, &mut encoder, &self.panel_renderer, target, panels);
        } else {
            let mut pass = begin_pass(&mut encoder, &view, wgpu::LoadOp::Load).forget_lifetime();
            self.panel_renderer.render(&mut pass, &panels.primitives, &screen);
        }
        uploads.push(encoder.finish());
        queue.submit(uploads);
    }

    fn update_textures(&mut self, textures: &egui::TexturesDelta) {
        for (&id, deltas) in &textures.set {
            for delta in deltas {
                self.panel_renderer.update_texture(&self.gpu.device, &self.gpu.queue, id, delta);
            }
        }
    }
}

/// Creates the canvas. On a software driver its shaders are compiled now instead of during the first frames.
fn new_canvas(gpu: &Gpu, format: wgpu::TextureFormat) -> Canvas {
    let mut canvas = Canvas::new(gpu, format);
    if canvas.is_software() {
        canvas.warm_up(gpu);
    }
    canvas
}

/// Configures a surface. wgpu refuses while another thread submits work to the device, for example a bake that uploads
/// light. The call is therefore repeated for two seconds.
fn configure(gpu: &Gpu, surface: &wgpu::Surface<'_>, config: &wgpu::SurfaceConfiguration) -> anyhow::Result<()> {
    let mut last = None;
    for _ in 0..MAX_ATTEMPTS {
        gpu.check()?;
        let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
        surface.configure(&gpu.device, config);
        last = pollster::block_on(scope.pop());
        if last.is_none() {
            return Ok(());
        }
        std::thread::sleep(PAUSE);
    }
    let cause = last.map_or_else(String::new, |error| error.to_string());
    Err(anyhow::anyhow!("the window cannot be drawn into at {}x{} pixels: {cause}", config.width, config.height))
}

/// Returns the configuration of the surface. It is synchronised with the screen. Its format has no sRGB conversion,
/// since picture and panels encode sRGB themselves and panels blend in that space.
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
