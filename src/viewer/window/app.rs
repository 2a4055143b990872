//! The application of winit: opens the window, passes events on, and sleeps between them.

use std::sync::Arc;

use anyhow::{Context, anyhow};
use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::event::{DeviceEvent, DeviceId, WindowEvent};
use winit::event_loop::{ActiveEventLoop, DeviceEvents, EventLoop, EventLoopProxy};
use winit::window::{Window, WindowId};

use crate::viewer::options::ViewerOptions;
use crate::viewer::session::user_event::UserEvent;
use crate::viewer::window::viewer::Viewer;

/// Size of a new window, points.
const SIZE: LogicalSize<f64> = LogicalSize::new(1280.0, 720.0);
/// Smallest size of the window, in which the panels are still usable, points.
const SMALLEST: LogicalSize<f64> = LogicalSize::new(480.0, 320.0);

/// Largest number of times that a lost device is replaced. A device that is lost more often is not usable.
const MAX_RECOVERIES: u32 = 3;

/// The application of winit.
struct App {
    options: ViewerOptions,
    proxy: EventLoopProxy<UserEvent>,
    /// `None` before the first event.
    viewer: Option<Viewer>,
    /// The error with which the window could not be opened or drawn into.
    failure: Option<anyhow::Error>,
    /// How often a lost device has been replaced.
    num_recoveries: u32,
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// Returns an error if there is no display, or no graphics device that can draw into a window.
pub fn run(options: ViewerOptions) -> anyhow::Result<()> {
    let events = EventLoop::with_user_event().build().map_err(|error| {
        log::info!("{error}");
        anyhow!(
            "cannot open a window: there is no display. `hemicube render` makes pictures without one, \
             `xvfb-run hemicube` gives the window a virtual display"
        )
    })?;
    let mut app = App { options, proxy: events.create_proxy(), viewer: None, failure: None, num_recoveries: 0 };
    events.run_app(&mut app).context("the display was lost")?;
    app.failure.map_or(Ok(()), Err)
}

impl App {
    fn open(&self, event_loop: &ActiveEventLoop) -> anyhow::Result<Viewer> {
        let attributes =
            Window::default_attributes().with_title("Hemicube").with_inner_size(SIZE).with_min_inner_size(SMALLEST);
        let window = Arc::new(event_loop.create_window(attributes).context("cannot open a window")?);
        // Without a window manager no window has the focus, and by default raw motion is reported only to a window with
        // the focus.
        event_loop.listen_device_events(DeviceEvents::Always);
        self.viewer_in(window, &self.options)
    }

    /// Creates the viewer of a window. Watches the folder of shaders if the options name one.
    fn viewer_in(&self, window: Arc<Window>, options: &ViewerOptions) -> anyhow::Result<Viewer> {
        let mut viewer = Viewer::new(window, options, self.proxy.clone())?;
        if let Some(folder) = options.shaders.clone() {
            viewer.watch_shaders(folder, self.proxy.clone());
        }
        Ok(viewer)
    }

    /// Replaces a lost device, loads the scene again and shows a message with the reason.
    fn recover(&mut self, event_loop: &ActiveEventLoop) {
        let Some(error) = self.viewer.as_mut().and_then(|viewer| viewer.failure.take()) else { return };
        log::warn!("the graphics device is replaced: {error:#}");
        self.num_recoveries += 1;
        let recovered = match self.viewer.take() {
            Some(lost) if self.num_recoveries <= MAX_RECOVERIES => {
                let (window, options, pose) = lost.reopening(&self.options);
                // A window has one surface: the old one is dropped before the new one is created.
                drop(lost);
                self.viewer_in(window, &options).map(|viewer| viewer.after_loss(&error, pose))
            }
            _ => Err(error),
        };
        match recovered {
            Ok(viewer) => self.viewer = Some(viewer),
            Err(error) => {
                self.failure = Some(error.context("the graphics device was lost"));
                event_loop.exit();
            }
        }
    }
}

impl ApplicationHandler<UserEvent> for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.viewer.is_some() {
            return;
        }
        match self.open(event_loop) {
            Ok(viewer) => self.viewer = Some(viewer),
            Err(error) => {
                self.failure = Some(error);
                event_loop.exit();
            }
        }
    }

    fn user_event(&mut self, _: &ActiveEventLoop, event: UserEvent) {
        if let Some(viewer) = &mut self.viewer {
            viewer.on_user_event(event);
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        if let Some(viewer) = &mut self.viewer
            && viewer.on_window_event(&event)
        {
            event_loop.exit();
        }
        self.recover(event_loop);
    }

    fn device_event(&mut self, _: &ActiveEventLoop, _: DeviceId, event: DeviceEvent) {
        if let Some(viewer) = &mut self.viewer {
            viewer.on_device_event(&event);
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        if let Some(viewer) = &mut self.viewer {
            event_loop.set_control_flow(viewer.plan());
        }
    }

    fn exiting(&mut self, _: &ActiveEventLoop) {
        // Ends the bake and drops the surface while the display still exists.
        self.viewer = None;
    }
}
