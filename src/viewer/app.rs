//! winit's side of the window: opens it, hands events on, sleeps in between.

use std::sync::Arc;

use anyhow::{Context, anyhow};
use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::event::{DeviceEvent, DeviceId, WindowEvent};
use winit::event_loop::{ActiveEventLoop, DeviceEvents, EventLoop, EventLoopProxy};
use winit::window::{Window, WindowId};

use super::ViewerOptions;
use super::walkthrough::Walkthrough;
use super::worker::News;

/// Size of a new window, points.
const SIZE: LogicalSize<f64> = LogicalSize::new(1280.0, 720.0);
/// Smallest size in which the panels make sense, points.
const SMALLEST: LogicalSize<f64> = LogicalSize::new(480.0, 320.0);

/// The program as winit sees it.
struct App {
    options: ViewerOptions,
    proxy: EventLoopProxy<News>,
    /// None before the first event.
    walkthrough: Option<Walkthrough>,
    /// Why the window could not be opened.
    failure: Option<anyhow::Error>,
}

/// As [`super::run`].
pub(super) fn run(options: ViewerOptions) -> anyhow::Result<()> {
    let events = EventLoop::with_user_event().build().map_err(|error| {
        log::info!("{error}");
        anyhow!(
            "cannot open a window: no display answers. `hemicube render` makes pictures without one, \
             `xvfb-run hemicube` gives the window a virtual display"
        )
    })?;
    let mut app = App { options, proxy: events.create_proxy(), walkthrough: None, failure: None };
    events.run_app(&mut app).context("the display was lost")?;
    app.failure.map_or(Ok(()), Err)
}

impl App {
    fn open(&self, event_loop: &ActiveEventLoop) -> anyhow::Result<Walkthrough> {
        let attributes =
            Window::default_attributes().with_title("Hemicube").with_inner_size(SIZE).with_min_inner_size(SMALLEST);
        let window = Arc::new(event_loop.create_window(attributes).context("cannot open a window")?);
        // Without a window manager nothing ever has the focus, and the mouse would be silent.
        event_loop.listen_device_events(DeviceEvents::Always);
        Walkthrough::new(window, &self.options, self.proxy.clone())
    }
}

impl ApplicationHandler<News> for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.walkthrough.is_some() {
            return;
        }
        match self.open(event_loop) {
            Ok(walkthrough) => self.walkthrough = Some(walkthrough),
            Err(error) => {
                self.failure = Some(error);
                event_loop.exit();
            }
        }
    }

    fn user_event(&mut self, _: &ActiveEventLoop, news: News) {
        if let Some(walkthrough) = &mut self.walkthrough {
            walkthrough.on_news(news);
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        if let Some(walkthrough) = &mut self.walkthrough
            && walkthrough.on_window_event(&event)
        {
            event_loop.exit();
        }
    }

    fn device_event(&mut self, _: &ActiveEventLoop, _: DeviceId, event: DeviceEvent) {
        if let Some(walkthrough) = &mut self.walkthrough {
            walkthrough.on_device_event(&event);
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        if let Some(walkthrough) = &mut self.walkthrough {
            event_loop.set_control_flow(walkthrough.plan());
        }
    }

    fn exiting(&mut self, _: &ActiveEventLoop) {
        // Ends the bake and gives the surface back while the display is still there.
        self.walkthrough = None;
    }
}
